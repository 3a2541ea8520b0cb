# SPDX-License-Identifier: Apache-2.0
"""The plots of docs/accuracy.md. The same figures give the same bytes."""
import io

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter, NullLocator
from PIL import Image

matplotlib.rcParams.update({
    "font.family": "sans-serif", "font.size": 9,
    "axes.spines.top": False, "axes.spines.right": False, "axes.titlesize": 9,
    "savefig.facecolor": "white"})

# Okabe and Ito's, that people tell apart who do not see all colours; and a mark each.
LOOKS = (("#000000", "o"), ("#0072B2", "s"), ("#56B4E9", "D"), ("#D55E00", "^"), ("#E69F00", "v"),
         ("#009E73", "P"), ("#CC79A7", "X"), ("#888888", "<"))


def save(figure, path):
    """In few colours, which makes a third of the bytes."""
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=120, bbox_inches="tight")
    plt.close(figure)
    Image.open(drawn).convert("RGB").quantize(64, dither=Image.Dither.NONE).save(path, optimize=True)


def plain(value, _=None):
    return f"{value:g}"


def show_plain_log(axis):
    axis.set_major_locator(LogLocator(base=10, subs=(1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(plain))
    axis.set_minor_formatter(NullFormatter())


def drift_percent(figures):
    return figures["drift_percent"]


def rpe_mm(figures):
    return 1000 * figures["rpe_rmse_m"]


def plot_widths(path, by_recording):
    """@param by_recording  recording → [(width in px, figures)]."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.8), layout="constrained")
    for (recording, series), (colour, marker) in zip(by_recording.items(), LOOKS):
        widths = [width for width, _ in series]
        look = {"color": colour, "marker": marker, "markersize": 5, "linewidth": 1.4}
        if recording.is_long:
            left.plot(widths, [drift_percent(f) for _, f in series], **look)
        right.plot(widths, [rpe_mm(f) for _, f in series], label=recording.name, **look)
    for axes, title in ((left, "drift, %"), (right, "RPE, mm a frame")):
        axes.set_title(title, loc="left")
        axes.set_xlabel("width of the thumbnail, px")
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xticks(sorted({width for series in by_recording.values() for width, _ in series}))
        axes.xaxis.set_major_formatter(FuncFormatter(plain))
        axes.xaxis.set_minor_locator(NullLocator())
        show_plain_log(axes.yaxis)
        axes.grid(axis="y", color="#dddddd", linewidth=0.6)
    figure.legend(*right.get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, 0),
                  ncol=4, frameon=False)
    save(figure, path)


# Of the bars: what is shown, in which unit, where beside the name, how.
BAR_HEIGHT = 0.36
ERRORS = ((drift_percent, "drift, %:", -0.19, {"color": "#D55E00"}),
          (rpe_mm, "RPE, mm:", 0.19, {"color": "#56B4E9"}))
RATIO_RANGE = (0.4, 6.0)


def draw_ratios(axes, bars, usual, look):
    """@param bars  (place, error) each; what lies beyond the axis ends at its edge in an arrow."""
    least, most = RATIO_RANGE
    for place, error in bars:
        ratio = error / usual
        shown = min(max(ratio, least), most)
        axes.barh(place, shown - 1, left=1, height=BAR_HEIGHT, **look)
        text = f"{error:.3g}" + (" →" if ratio > most else "")
        axes.annotate(text, (max(shown, 1), place), xytext=(3, 0), textcoords="offset points",
                      fontsize=7, va="center")


def plot_ablations(path, by_recording):
    """@param by_recording  recording → [(what was exchanged, figures)], as configured first."""
    columns = 4
    rows = -(-len(by_recording) // columns)
    names = [name for name, _ in next(iter(by_recording.values()))][1:]
    figure, grid = plt.subplots(rows, columns, figsize=(8.4, rows * (0.8 + 0.28 * len(names))),
                                sharex=True, sharey=True, squeeze=False, layout="constrained")
    for axes, (recording, series) in zip(grid.flat, by_recording.items()):
        (_, usual), *others = series
        title = recording.name
        for error, unit, offset, look in ERRORS:
            if error(usual) is None:
                continue
            title += f"\n{unit} {error(usual):.3g}"
            bars = [(i + offset, error(figures)) for i, (_, figures) in enumerate(others)]
            draw_ratios(axes, bars, error(usual), look)
        axes.set_title(title, loc="left")
        axes.axvline(1, color="black", linewidth=0.8)
    for axes in grid.flat:
        axes.set_xscale("log")
        axes.set_xlim(RATIO_RANGE[0], RATIO_RANGE[1] * 1.9)  # room for numbers
        axes.xaxis.set_major_locator(FixedLocator((0.5, 1, 2, 4)))
        axes.xaxis.set_major_formatter(FuncFormatter(plain))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.tick_params(axis="y", length=0)
        axes.set_yticks(range(len(names)), names)
    grid[0, 0].invert_yaxis()  # which all share
    for axes in grid.flat[len(by_recording):]:
        axes.set_axis_off()
    handles = [plt.Rectangle((0, 0), 1, 1, **look) for _, _, _, look in ERRORS]
    figure.legend(handles, ["drift", "RPE"], loc="upper center", bbox_to_anchor=(0.5, 0), ncol=2,
                  frameon=False)
    figure.supxlabel("times the error as configured, which is above; at each bar the error itself",
                     fontsize=9)
    save(figure, path)
