"""Sort a few numbers inside a compiled loop; compiling NumPy's general sort there would take two seconds."""

from stiction.engine.compiled import formula


@formula
def sort_few(values):
    """Sort a short one-dimensional array in place, in ascending order, by insertion."""
    for i in range(1, values.size):
        value, place = values[i], i
        while place > 0 and values[place - 1] > value:
            values[place] = values[place - 1]
            place -= 1
        values[place] = value
