"""How Sphinx makes a site of the gathered pages: see `build`."""

import html

import docutils.nodes

project = "dovetail"
copyright = "its authors, GPL 3 or later"
extensions = ["myst_parser"]
root_doc = "README"
# Anchors of headings as git hosts make them, so that a link works in both places.
myst_heading_anchors = 4
# Indented blocks are formulas and command lines, not Python.
highlight_language = "none"
html_theme = "alabaster"
html_theme_options = {
    "description": "Dovetail joints shaped against fretting wear",
    "page_width": "min(1280px, 100%)",
    "sidebar_width": "240px",
    "fixed_sidebar": True,
    "show_powered_by": False,
    # Nothing from the network, whatever fonts a machine has.
    "font_family": "system-ui, sans-serif",
    "head_font_family": "system-ui, sans-serif",
    "font_size": "16px",
}
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html", "reference.html"]}
templates_path = ["."]
# Formulas are drawn by KaTeX, which `build` puts beside these: nothing is fetched.
myst_enable_extensions = ["dollarmath"]
html_math_renderer = "katex"
html_static_path = ["site.css", "equations.js"]
html_css_files = ["site.css", "katex.min.css"]
html_js_files = ["katex.min.js", "equations.js"]
html_copy_source = False


def setup(app):
    def formula(tag):
        def write(translator, node):
            translator.body.append(f'<{tag} class="formula">{html.escape(node.astext())}</{tag}>')
            raise docutils.nodes.SkipNode
        return write

    app.add_html_math_renderer("katex", (formula("span"), None), (formula("div"), None))
