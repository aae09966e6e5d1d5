#!/usr/bin/env python3
"""Plain words: how long the documentation is, and what in it a reader would need a glossary for.

usage: words.py            numbers of each page, of help texts and messages; status 1 if one has coined words, or
                           all pages have too many
       words.py FILE...    each coined word and long sentence of these files (.md, .cpp, .hpp), with its line

words      pieces between blanks that hold a letter or a digit, code and tables included
coined     words that are ours and not the field's (COINED), in running text: not in fences, code or addresses
long       sentences of more than 30 words
Help texts and messages are the C++ string literals that hold a blank, without examples of commands.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LONG = 30
COINED = r"""
    rid(?:e|es|er|ers|ing) | convoys? | flocks? | fleets? | wagons? | errands? | abreast | wings? | sets?\ off | gets?\ off
    passengers? | books | crews? | handouts? | workplaces? | paces?
    tells? | told | telling | foretold | in\ words | besides? | judged?s? | judging
    contenders? | convinc(?:es?|ed|ing(?:ly)?) | floors?\ (?:are\ |is\ )?left | floors\ remain
    bent | strain(?:s|ed)? | straight\ numbers | stands?\ in\ for | standing\ in | left\ open | leaves?\ open | doubts?
    valleys? | believes? | believed | beliefs? | disown(?:s|ed)? | forgets? | g[ia]ve[sn]?\ up | spare[sd]? | befalls?
    guests? | briefings? | asks?\ for | asked\ for | speaks?\ for | speaking\ for | hears? | heard | feels? | felt
    how-manieth | hangs?\ through | go(?:es)?\ by | make\ up\ for | comes?\ near(?:est)? | nobody\ knows | earned
    asked\ of | as\ ever | what\ comes\ of | in\ company | of\ one's\ own\ accord
"""
COINED = re.compile(rf"(?<![\w`-])(?:{'|'.join(p.strip() for line in COINED.strip().splitlines() for p in line.split(' | '))})(?![\w-])", re.I)
MOST_WORDS = 50000
LITERAL = re.compile(r'"(?:[^"\\\n]|\\.)*"')


def words(text):
    return sum(any(c.isalnum() for c in word) for word in text.split())


def blanked(pattern, text, flags=re.S | re.M):
    """The text without what the pattern matches, its lines where they were."""
    return re.sub(pattern, lambda found: "\n" * found[0].count("\n"), text, flags=flags)


def running_text(page):
    """A page's sentences: no fences, comments, code, formulas or addresses."""
    text = blanked(r"^ *```.*?^ *```$", page)
    text = blanked(r"<!--.*?-->", text)
    text = re.sub(r"`[^`\n]*`", "x", text)
    return re.sub(r"\]\([^)\n]*\)|<https?:[^>\n]*>|https?://\S+", "]", text)


def messages(source):
    """String literals of a C++ file that hold a blank, with their lines; neighbours are one."""
    source = blanked(r"//[^\n]*$|/\*.*?\*/", re.sub(r'"(?:[^"\\\n]|\\.)*"', lambda m: m[0].replace("//", "/ /"), source))
    place, text, line = None, "", 1
    for found in LITERAL.finditer(source):
        between = source[place:found.start()] if place is not None else ","
        if between.strip():
            if " " in text.strip():
                yield line, text
            text, line = "", source.count("\n", 0, found.start()) + 1
        text, place = text + re.sub(r"^ *mckibben .*|`[^`]*`", "", found[0][1:-1]).replace("\\n", "\n"), found.end()
    if " " in text.strip():
        yield line, text


def sentences(text):
    """Line and text of each sentence; a table's cells, a list's items and headings are by themselves."""
    line = 1
    for block in re.split(r"(\n(?:\s*\n|(?=\s*(?:[-*|#>]|\d+\. )))|\|)", text):
        start = line
        for sentence in re.split(r"(?<=[.!?:;])[*)\"]*\s+", block):
            yield start, " ".join(sentence.split())
        line += block.count("\n")


def findings(path):
    """Line, kind and text of each coined word and long sentence."""
    text = path.read_text()
    parts = [(1, running_text(text))] if path.suffix == ".md" else messages(text)
    for first, part in parts:
        for found in COINED.finditer(part):
            yield first + part.count("\n", 0, found.start()), "coined", found[0]
        for line, sentence in sentences(part):
            if words(sentence) > LONG:
                yield first + line - 1, "long", sentence


def count(paths):
    found = [kind for path in paths for _, kind, _ in findings(path)]
    return sum(words(path.read_text()) for path in paths), found.count("coined"), found.count("long")


def main():
    if sys.argv[1:]:
        for name in sys.argv[1:]:
            for line, kind, text in findings(Path(name)):
                print(f"{name}:{line}: {kind}: {text}")
        return 0
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    wrong = []
    print(" words coined long")
    for page in pages:
        name = str(page.relative_to(ROOT))
        total, coined, long = count([page])
        print(f"{total:6} {coined:6} {long:4}  {name}")
        if coined:
            wrong.append(f"{name} has coined words: tests/docs/words.py {name}")
    print("{:6} {:6} {:4}  docs".format(*count(pages[1:])))
    total = count(pages[1:])[0]
    if total > MOST_WORDS:
        wrong.append(f"the pages have {total} words, more than {MOST_WORDS}")
    for room in ["plant", "controllers", *sorted(f"sim/{path.name}" for path in (ROOT / "sim").iterdir() if path.is_dir())]:
        _, coined, long = count(sorted((ROOT / room).rglob("*.[ch]pp")))
        print(f"       {coined:6} {long:4}  messages of {room}")
        if coined:
            wrong.append(f"messages of {room} have coined words: tests/docs/words.py $(find {room} -name '*.?pp')")
    print("\n".join(wrong))
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
