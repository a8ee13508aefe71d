"""Sort a few numbers inside a kernel; NumPy's general sort takes two seconds to compile."""

from stiction.engine.compiled import formula


@formula
def sort_few(values):
    """Sort a short array in place, by insertion."""
    for i in range(1, values.size):
        value, place = values[i], i
        while place > 0 and values[place - 1] > value:
            values[place] = values[place - 1]
            place -= 1
        values[place] = value
