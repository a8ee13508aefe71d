"""The page as `stiction serve` sets it up, for users who are simulated: they call the server by a name that no browser does."""

from stiction.web.server import question_of, serve

serve(question_of(None), "0.0.0.0", 8080)
