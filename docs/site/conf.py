"""How Sphinx builds the site; `build.py` lays out what it reads."""

from importlib.metadata import version as version_of

project = "stiction"
author = "The stiction authors"
project_copyright = "the stiction authors"
version = release = version_of("stiction")

extensions = [
    "myst_parser",
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",  # the formulas' script and letters, copied into the site
    "sphinx_copybutton",
    "sphinx_design",
]
root_doc = "index"
nitpicky = True
templates_path: list[str] = []
exclude_patterns: list[str] = []
smartquotes = False  # options of commands have two hyphens

myst_enable_extensions = ["attrs_block", "attrs_inline", "colon_fence", "deflist", "dollarmath", "html_image"]
myst_heading_anchors = 5
myst_dmath_double_inline = True
# Only what is formula is looked through: a page of models has hundreds.
mathjax3_config = {"options": {"enableMenu": False}}

html_theme = "furo"
html_title = f"stiction {version}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#00507a", "color-brand-content": "#00679c"},
    "dark_css_variables": {"color-brand-primary": "#7cc4ea", "color-brand-content": "#7cc4ea"},
}
copybutton_exclude = ".linenos, .gp, .go"
pygments_style = "default"
pygments_dark_style = "github-dark"


def setup(app):
    """Tables of measured series are shown as they are; what MyST and Sphinx leave to be done is done to every page."""
    from pygments.lexers.special import TextLexer

    app.add_lexer("csv", TextLexer)
    app.connect("html-page-context", short_sidebar, priority=900)  # after the theme
    app.connect("doctree-read", numbered_as_written)
    app.connect("doctree-read", sentences_wrap)
    app.connect("doctree-read", pictures_open)


def short_sidebar(app, pagename, templatename, context, doctree):
    """Two levels only: pages of laws and names are reached from their lists."""
    from furo.navigation import get_navigation_tree

    if "toctree" in context:
        tree = context["toctree"](collapse=False, titles_only=True, maxdepth=2, includehidden=True)
        context["furo_navigation_tree"] = get_navigation_tree(tree)


def numbered_as_written(app, doctree):
    r"""Sphinx puts formulas of several lines into an environment in which no \tag may stand: these are left as they are."""
    from docutils import nodes

    for formula in doctree.findall(nodes.math_block):
        if r"\tag" in formula.astext():
            text = rf"\[{formula.astext()}\]"
            formula["nowrap"] = formula["no-wrap"] = True
            formula.children = [nodes.Text(text)]
            formula.rawsource = text


LONG = 120  # characters: more than a table has


def sentences_wrap(app, doctree):
    """What a program says in sentences, such as its validity warnings, is wrapped, where a table scrolls."""
    from docutils import nodes

    for block in doctree.findall(nodes.literal_block):
        if block.get("language") == "text" and any(len(line) > LONG for line in block.astext().splitlines()):
            block["classes"].append("sentences")


def pictures_open(app, doctree):
    """A picture leads to itself in its full size, which a narrow screen needs."""
    from docutils import nodes

    for picture in doctree.findall(nodes.image):
        if not isinstance(picture.parent, nodes.reference) and "sd-card-img-top" not in picture["classes"]:
            picture["width"] = "100%"  # Sphinx links those that say a width; the style leaves it as it is
            picture["classes"].append("opens")
