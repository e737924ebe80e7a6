# SPDX-License-Identifier: GPL-3.0-or-later
# Settings of the documentation site; run by build.sh.
import os
from pathlib import Path

project = "Hyperex"
author = "the authors of Hyperex"
version = release = os.environ["HYPEREX_VERSION"]
out = Path(os.environ["HYPEREX_DOCS_OUT"])

extensions = ["myst_parser", "sphinx.ext.mathjax"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
root_doc = "index"
# README.md is in index.md. Of src and examples single files are linked to; they hold no pages.
exclude_patterns = ["README.md", "docs/site", "src", "examples"]

# The same Markdown as on a forge: anchors of headings, formulas between dollars.
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4
myst_dmath_double_inline = True
myst_update_mathjax = False
suppress_warnings = ["myst.header"]  # a README may begin with a section of the second level
highlight_language = "none"

cpp_index_common_prefix = ["hyperex::"]

html_theme = "furo"
html_title = f"Hyperex {version}"
html_static_path = [str(Path(__file__).parent / "_static"), str(out / "static")]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_copyright = False
# Debian's build of the theme lacks its dark colours; these are the theme's own (furo, variables/_colors.scss).
html_theme_options = {
    "navigation_with_keys": True,
    "dark_css_variables": {
        "color-problematic": "#ee5151",
        "color-foreground-primary": "#ffffffcc",
        "color-foreground-secondary": "#9ca0a5",
        "color-foreground-muted": "#81868d",
        "color-foreground-border": "#666666",
        "color-background-primary": "#131416",
        "color-background-secondary": "#1a1c1e",
        "color-background-hover": "#1e2124ff",
        "color-background-hover--transparent": "#1e212400",
        "color-background-border": "#303335",
        "color-background-item": "#444",
        "color-brand-primary": "#2b8cee",
        "color-brand-content": "#368ce2",
        "color-highlighted-background": "#083563",
        "color-guilabel-background": "#08356380",
        "color-guilabel-border": "#13395f80",
        "color-api-keyword": "var(--color-foreground-secondary)",
        "color-highlight-on-target": "#333300",
        "color-admonition-background": "#18181a",
        "color-card-background": "#18181a",
        "color-card-marginals-background": "var(--color-background-hover)",
    },
}
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {
    "messageStyle": "none",
    "tex2jax": {"inlineMath": [["\\(", "\\)"]], "displayMath": [["\\[", "\\]"]],
                "processClass": "math", "ignoreClass": "document"},
    "SVG": {"linebreaks": {"automatic": False}},
}


def at_home(app, env, node, contnode):
    """Links to README.md lead to the first page, and those to folders of the repository are left as words."""
    target = node.get("reftarget", "").split("#")[0]
    here = Path(app.srcdir) / node.get("refdoc", "")
    there = (here.parent / target).resolve() if target else None
    if there == (Path(app.srcdir) / "README.md").resolve():
        from sphinx.util.nodes import make_refnode
        return make_refnode(app.builder, node["refdoc"], "index", "", contnode)
    if there and there.is_dir():
        return contnode
    return None


def setup(app):
    app.connect("missing-reference", at_home)
