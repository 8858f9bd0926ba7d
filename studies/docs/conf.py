"""How Sphinx makes a site of the gathered pages: see `build`."""

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
    "page_width": "1280px",
    "sidebar_width": "240px",
    "fixed_sidebar": True,
    "show_powered_by": False,
    # Nothing from the network, whatever fonts a machine has.
    "font_family": "system-ui, sans-serif",
    "head_font_family": "system-ui, sans-serif",
    "font_size": "16px",
}
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
html_static_path = ["site.css"]
html_css_files = ["site.css"]
html_copy_source = False
