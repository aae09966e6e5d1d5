"""What mkdocs does besides: formulas (fences ```math, TeX) become MathML, which browsers draw by themselves."""
import html
import re
import subprocess
import xml.etree.ElementTree as xml


def mathml(tex):
    """One formula; `\tag{T 2.8}` is set at the right. Raises RuntimeError for TeX that blahtex cannot read."""
    tags = re.findall(r"\\tag\{([^}]*)\}", tex)
    tex = re.sub(r"\\tag\{[^}]*\}", "", tex).strip()
    done = subprocess.run(["blahtexml", "--mathml"], input=tex, capture_output=True, text=True, check=True)
    markup = re.search(r"<markup>\s*(.*?)\s*</markup>", done.stdout, re.S)
    if not markup:
        message = xml.fromstring(done.stdout).findtext(".//message")
        raise RuntimeError(f"formula: {message}\n{tex}")
    markup = re.sub(r"(<mo[^>]*>)-(</mo>)", "\\1\N{MINUS SIGN}\\2", markup[1])
    source = f'<span class="source">{html.escape(", ".join(tags))}</span>' if tags else ""
    return f'<div class="formula"><math display="block">{markup}</math>{source}</div>'


def on_page_markdown(markdown, **_):
    return re.sub(r"^```math\n(.*?)^```$", lambda fence: mathml(fence[1]), markdown, flags=re.S | re.M)
