"""What the pages share: their style, tables, figures within the page, one file that is whole or absent."""

import base64
import html
import re

import whole

STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222;background:#fff}
table{border-collapse:collapse;margin:1rem 0;font-size:.85rem}td,th{border-bottom:1px solid #ccc;padding:.25rem .6rem;text-align:right}
th{border-bottom:2px solid #444}td:first-child,th:first-child{text-align:left}img,svg{max-width:100%;height:auto}
figure{margin:1rem 0}figcaption{font-size:.85rem;color:#444}.missing{color:#a00}.table{overflow-x:auto}h1,h2{overflow-wrap:anywhere}"""


def as_html(head, rows):
    cell = lambda tag, values: "<tr>" + "".join(f"<{tag}>{html.escape(str(v))}</{tag}>" for v in values) + "</tr>"
    return '<div class="table"><table>' + cell("th", head) + "".join(cell("td", row) for row in rows) + "</table></div>"


def from_markdown(path):
    """The table of a .md file, and the lines after it."""
    if not path.exists():
        return missing(path)
    lines = path.read_text(encoding="utf-8").strip().splitlines()
    rows = [[c.strip() for c in line.strip("|").split("|")] for line in lines if line.startswith("|")]
    end = max(k for k, line in enumerate(lines) if line.startswith("|"))
    rest = " ".join(lines[end + 1:])
    return as_html(rows[0], rows[2:]) + f"<p>{html.escape(rest)}</p>"


def missing(path):
    return f'<p class="missing">{html.escape(path.name)} was not made in this run.</p>'


def figure(path, caption):
    if not path.exists():
        return missing(path)
    if path.suffix == ".svg":
        # Ids must differ between the figures of a page.
        text = re.sub(r"^.*?(?=<svg)", "", path.read_text(), flags=re.S)
        tag = re.sub(r"\W", "", path.stem) + "-"
        text = re.sub(r'(id="|url\(#|href="#)', lambda m: m.group(1) + tag, text)
        body = text
    else:
        body = f'<img alt="" src="data:image/png;base64,{base64.b64encode(path.read_bytes()).decode()}">'
    return f"<figure>{body}<figcaption>{caption}</figcaption></figure>"


def write(out, title, parts, style=""):
    body = "\n".join(parts)
    text = ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1">'
            f'<title>{html.escape(title)}</title><style>{STYLE}{style}</style></head><body>\n{body}\n</body></html>\n')
    whole.write_text(out, text)
