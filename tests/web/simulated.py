"""The page as `stiction serve` sets it up, for users who are simulated: they call the server by a name that no browser does."""

from stiction.web.server import query_of, serve

serve(query_of(None), "0.0.0.0", 8080)
