# SPDX-License-Identifier: Apache-2.0
"""The plots of docs/robustness.md, in the looks of docs/accuracy.md."""
import cases  # which finds the accuracy scripts
import plots
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, NullLocator
from verdicts import error

LINES = {"bit-planes": "-", "intensity": ":"}
LOG_LEVELS = ("electrons", "gamma")


def draw_panel(axes, name, levels, figures_of):
    axes.set_title(name, loc="left")
    axes.set_yscale("log")
    plots.show_plain_log(axes.yaxis)
    axes.grid(axis="y", color="#dddddd", linewidth=0.6)
    if name in LOG_LEVELS:
        axes.set_xscale("log")
    if name == "electrons":
        axes.invert_xaxis()  # what is worse is to the right
    axes.set_xticks(levels)
    axes.xaxis.set_major_formatter(FuncFormatter(plots.plain))
    axes.xaxis.set_minor_locator(NullLocator())
    for (recording, descriptor), (colour, marker, errors, clean) in figures_of.items():
        axes.plot(levels, errors, LINES[descriptor], color=colour, marker=marker, markersize=4,
                  linewidth=1.4)
        if descriptor == "bit-planes":
            axes.axhline(clean, color=colour, linewidth=0.6, alpha=0.6)


def plot_levels(path, recordings, figures_of):
    """Error against level, a panel an injection.
    @param figures_of  (recording, descriptor, injection or "") → figures."""
    figure, grid = plots.plt.subplots(2, 3, figsize=(8.4, 5.2), layout="constrained")
    looks = list(zip(recordings, plots.LOOKS[1::2]))
    for axes, (name, levels) in zip(grid.flat, cases.PLOTTED.items()):
        series = {}
        for recording, (colour, marker) in looks:
            for descriptor, _ in cases.DESCRIPTORS:
                at = lambda text: error(recording, figures_of(recording, descriptor, text))
                errors = [at(f"{name}={level}") for level in levels]
                series[recording, descriptor] = (colour, marker, errors, at(""))
        draw_panel(axes, name, levels, series)
    for axes in grid[:, 0]:
        axes.set_ylabel("drift, %")
    handles = [Line2D([], [], color=colour, marker=marker, markersize=4, linestyle=LINES[descriptor],
                      label=f"{recording.name}, {descriptor}")
               for recording, (colour, marker) in looks for descriptor, _ in cases.DESCRIPTORS]
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=4, frameon=False)
    plots.save(figure, path)
