"""Titles, labels and names of a picture that lie on one another, or beyond its edge; numbers of ticks are left out."""

from itertools import combinations

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.legend import Legend
from matplotlib.text import Text

_TOUCH = 2.0  # pixels: letters that reach so far into another's box do not meet


def collisions(figure):
    """Return the pairs of texts that overlap, and the texts that are cut off, as they are drawn."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    ticks = [axis.get_ticklabels(which="both") for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)]
    inside = {id(text) for legend in figure.findobj(Legend) for text in legend.findobj(Text)} | {
        id(one) for some in ticks for one in some
    }
    drawn = [one for one in figure.findobj(Text) if one.get_visible() and one.get_text().strip() and id(one) not in inside]
    boxes = [(one.get_text(), one.get_window_extent(canvas.get_renderer())) for one in drawn]
    boxes = [(text, box) for text, box in boxes if box.width > 0.0 and box.x1 > 0.0]
    right, top = figure.bbox.x1 + _TOUCH, figure.bbox.y1 + _TOUCH
    cut = [text for text, box in boxes if box.x0 < -_TOUCH or box.x1 > right or box.y1 > top]
    return cut + [(one, other) for (one, a), (other, b) in combinations(boxes, 2)
                  if min(a.x1, b.x1) - max(a.x0, b.x0) > _TOUCH and min(a.y1, b.y1) - max(a.y0, b.y0) > _TOUCH]  # fmt: skip
