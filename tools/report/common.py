"""What all parts share: tables, numbers, where a measurement comes from."""

import math


class Bad(Exception):
    """A file that cannot be reported on; the text follows its name."""


def table(header, rows):
    """Lines of a Markdown table; all columns but the first to the right."""
    lines = ["| " + " | ".join(header) + " |",
             "|" + "|".join(["---"] + ["---:"] * (len(header) - 1)) + "|"]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return lines + [""]


def number(value, digits=3):
    """To so many significant digits, without an exponent where that is readable."""
    if value == 0:
        return "0"
    if not math.isfinite(value):
        return "-"
    places = digits - 1 - math.floor(math.log10(abs(value)))
    if places > 9:
        return f"{value:.{digits - 1}e}"
    return f"{round(value, places):.{max(places, 0)}f}"


def count(value):
    """12345678 -> 12,345,678"""
    return f"{value:,}"


def median(values):
    values = sorted(values)
    if not values:
        raise Bad("has a row without a measured time; measure again")
    middle = len(values) // 2
    return values[middle] if len(values) % 2 else 0.5 * (values[middle - 1] + values[middle])


def geometric_mean(values):
    return math.exp(sum(math.log(v) for v in values) / len(values))


def origin(data):
    """Lines that say on what this was measured."""
    machine = data["machine"]
    lines = [f"{machine['cpu']}, {machine['cores']} cores, {data['compiler']}, commit "
             f"{data['commit']}, {data['date']}"
             + (f", beside Embree {data['embree']}" if "embree" in data else "") + ".", ""]
    return lines
