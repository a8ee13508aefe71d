"""Set the limits beyond which a map solution gets a validity warning."""

TOLERANCE = 1e-5  # largest residual: rms gap error in contact, divided by the rms height difference of neighbouring points
LEAST_PIXELS = 8.0  # points in the shortest wave
LEAST_IN_WAVE = 4.0  # points in the shortest wave if only the area is needed, to a few per cent
LEAST_WAVES = 6.0  # longest waves along a side
STEEPEST = 0.3  # rms gradient, because the solver assumes small slopes
LEAST_CONTACT = 100  # points in contact
MOST_AT_ENDS = 0.01  # fraction of the load on the outermost points of a map with free edges
LEAST_LOAD_ERROR = 1e-9
LEAST_POINTS = 2.0  # points across the zone at the contact edge where attraction acts on separated faces (cohesive zone)
MOST_ATTRACTION_LEFT = 1e-3  # unbalanced pressure where attracting faces do not touch, divided by the largest attraction
LEAST_TABOR = 5.0  # smallest Tabor parameter at which a range of attraction counts as short
LEAST_WEAKENING = 3.0  # points along the length over which strength is lost, for the largest tangential force
