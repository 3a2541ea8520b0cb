# SPDX-License-Identifier: Apache-2.0
"""Pages whose tables are measured: what stands between `<!-- measured: NAME -->` and `<!-- end -->`
is written anew."""
import re

MARKS = re.compile(r"(<!-- measured: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
NUMBER = re.compile(r"[-+−]?\d")


def table(head, rows):
    """Words to the left, numbers to the right."""
    is_number = lambda column: any(NUMBER.match(str(row[column])) for row in rows)
    rule = ["---:" if is_number(column) and column > 0 else "---" for column in range(len(head))]
    lines = [head, rule] + rows
    return "".join("| " + " | ".join(str(cell) for cell in line) + " |\n" for line in lines)


def fill_page(page, write):
    """Puts `write(NAME)` between the marks of each NAME in the file `page`."""
    fill = lambda match: match[1] + "\n" + write(match[2]) + "\n" + match[3]
    page.write_text(MARKS.sub(fill, page.read_text()))
