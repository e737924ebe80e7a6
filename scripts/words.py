#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the words of the pages for people: README.md, the other pages at the root, and docs/**/*.md.

    scripts/words.py                 both checks, over all pages; ends with 1 where one fails
    scripts/words.py --count         how many long sentences each page has, exceptions included
    scripts/words.py PAGE...         both checks, over these pages alone

1. A sentence has at most 35 words. Headings, items of lists and cells of tables are sentences of
   their own; `code` and $formulas$ are one word each. Blocks of code, targets of links, and lists
   of references are not counted. scripts/words_allowed.txt lists the exceptions, each with a reason.
2. A relative link leads to a file of the repository, and its anchor to a heading of that page.

Prints FILE:LINE and the sentence or the link. Needs nothing but Python's standard library.
"""
import re
import sys
from pathlib import Path

LIMIT = 35
ROOT = Path(__file__).resolve().parent.parent
ALLOWED = ROOT / "scripts/words_allowed.txt"

# A full stop after these ends no sentence.
ABBREVIATIONS = re.compile(r"(?:^|[\s(])(?:e\.g|i\.e|cf|vs|al|fig|eq|vol|pp|approx)\.$", re.IGNORECASE)
SENTENCE_END = re.compile(r"[.!?][\"')\]*_]*(?=\s+[\"'(\[*_`\u00ab]*[A-Z0-9`$])")
FENCE = re.compile(r"^\s*(```+|~~~+)")
ITEM = re.compile(r"^\s*(?:[*+-]|\d+[.)])\s+")
HEADING = re.compile(r"^(#{1,6})\s+(.*?)\s*#*$")
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]*(?:\([^()]*\)[^()\s]*)*)(?:\s+\"[^\"]*\")?\)")


def pages():
    return [ROOT / "README.md"] + sorted(p for p in ROOT.glob("*.md") if p.name != "README.md") + sorted(
        ROOT.glob("docs/**/*.md"))


def blank_code(lines):
    """The lines with fenced code, comments and displayed formulas blanked; lines keep their numbers."""
    out, fence, comment, formula = [], None, False, False
    for line in lines:
        opened = FENCE.match(line)
        if fence:
            if opened and opened.group(1).startswith(fence):
                fence = None
            out.append("")
        elif comment:
            comment = "-->" not in line
            out.append("")
        elif formula:
            formula = not line.rstrip().endswith("$$")
            out.append("")
        elif opened:
            fence = opened.group(1)
            out.append("")
        elif line.lstrip().startswith("<!--"):
            comment = "-->" not in line
            out.append("")
        elif line.lstrip().startswith("$$"):
            formula = line.strip() == "$$" or not line.rstrip().endswith("$$")
            out.append("")
        else:
            out.append(line)
    return out


def blocks(lines):
    """(first line's number, kind, [(number, text)]) of paragraphs, items, cells and headings."""
    found, open_block, in_references, in_list = [], None, False, False

    def close():
        nonlocal open_block
        if open_block:
            found.append(open_block)
        open_block = None

    for number, line in enumerate(blank_code(lines), 1):
        heading = HEADING.match(line)
        if not line.strip():
            close()
            continue
        if heading:
            close()
            in_list = False
            in_references = bool(re.match(r"(references|sources|literature)\b", heading.group(2), re.IGNORECASE))
            found.append(("heading", [(number, heading.group(2))]))
        elif line.lstrip().startswith("|"):
            close()
            for cell in re.split(r"(?<!\\)\|", line.strip().strip("|")):
                if cell.strip() and not re.fullmatch(r"\s*:?-+:?\s*", cell):
                    found.append(("cell", [(number, cell.strip())]))
        elif ITEM.match(line):
            close()
            in_list = True
            kind = "reference" if in_references else "item"
            open_block = (kind, [(number, ITEM.sub("", line))])
        elif open_block:
            open_block[1].append((number, line.strip().lstrip("> ")))
        elif line.startswith("    ") and not in_list:
            continue  # indented code
        else:
            in_list = in_list and line.startswith(" ")
            open_block = ("reference" if in_references else "text", [(number, line.strip().lstrip("> "))])
    close()
    return found


def sentences(block):
    """(line, the sentence as it is read, as it is written) of one block."""
    text, starts = "", []
    for number, line in block:
        starts.append((len(text), number))
        text += line + "\n"
    # What is left out becomes zeros of the same length, so that places in `read` are places in `text`.
    spans = []

    def keep_length(pattern, replacement, source):
        return pattern.sub(lambda m: replacement(m)[: len(m.group(0))].ljust(len(m.group(0)), "\0"), source)

    read = keep_length(re.compile(r"(`+)(.+?)\1", re.DOTALL), lambda m: "`c`", text)
    read = keep_length(re.compile(r"\$[^$\s][^$]*\$"), lambda m: "`f`", read)
    read = keep_length(LINK, lambda m: "" if m.group(1) else m.group(2), read)
    begin = 0
    for end in SENTENCE_END.finditer(read):
        if ABBREVIATIONS.search(read[begin: end.start() + 1].replace("\0", "")):
            continue
        spans.append((begin, end.end()))
        begin = end.end()
    spans.append((begin, len(read)))
    for first, last in spans:
        said = read[first:last].replace("\0", "")
        if not said.strip():
            continue
        at = first + len(said) - len(said.lstrip()) if said else first
        line = max(number for start, number in starts if start <= at)
        yield line, " ".join(said.split()), " ".join(text[first:last].split())


def words(sentence):
    return sum(1 for word in sentence.split() if re.search(r"[^\W_]", word))


def anchors(page):
    """The anchors of a page's headings, as GitHub makes them. The documentation site knows no others (<a id=...>)."""
    names, seen = set(), {}
    text = page.read_text(encoding="utf-8")
    for line in blank_code(text.splitlines()):
        heading = HEADING.match(line)
        if not heading:
            continue
        name = LINK.sub(lambda m: m.group(2), heading.group(2)).replace("`", "").lower()
        name = re.sub(r"[^\w\- ]", "", name).replace(" ", "-")
        count = seen.get(name, 0)
        seen[name] = count + 1
        names.add(f"{name}-{count}" if count else name)
    return names


def links(page):
    """(line, what is wrong) of each relative link of a page that leads nowhere."""
    text = "\n".join(re.sub(r"`[^`]*`", lambda m: " " * len(m.group(0)), line)
                     for line in blank_code(page.read_text(encoding="utf-8").splitlines()))
    found = []
    for match in LINK.finditer(text):
        found.append((match.start(), match.group(3)))
        for inner in LINK.finditer(match.group(2)):  # a picture that is a link
            found.append((match.start(), inner.group(3)))
    for at, target in found:
        if re.match(r"[a-z]+:", target):
            continue
        line = text.count("\n", 0, at) + 1
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if not file.exists():
            yield line, f"link to {target}: there is no such file"
        elif anchor and file.suffix == ".md" and anchor not in anchors(file):
            yield line, f"link to {target}: {file.name} has no heading with that anchor"


def allowed():
    """[page, beginning of the sentence or '*', times used]: one a line, PAGE: BEGINNING  # reason."""
    entries = []
    for number, line in enumerate(ALLOWED.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        match = re.fullmatch(r"(\S+): (.+?)  # (.+)", line)
        if not match:
            sys.exit(f"{ALLOWED.relative_to(ROOT)}:{number}: expected PAGE: BEGINNING  # reason; found {line!r}")
        entries.append([match.group(1), match.group(2), 0, number])
    return entries


def long_sentences(page):
    for kind, block in blocks(page.read_text(encoding="utf-8").splitlines()):
        if kind == "reference":
            continue
        for line, said, written in sentences(block):
            if words(said) > LIMIT:
                yield line, words(said), written


def main(arguments):
    if "-h" in arguments or "--help" in arguments:
        print(__doc__)
        return 0
    if "--count" in arguments:
        counts = {page.relative_to(ROOT).as_posix(): len(list(long_sentences(page))) for page in pages()}
        for name, count in counts.items():
            print(f"{count:5d}  {name}")
        print(f"{sum(counts.values()):5d}  together")
        return 0
    chosen = [Path(a).resolve() for a in arguments] or pages()
    exceptions = allowed()
    wrong = excused = 0
    for page in chosen:
        name = page.relative_to(ROOT).as_posix()
        for line, count, written in long_sentences(page):
            exception = next((e for e in exceptions
                              if e[0] == name and (e[1] == "*" or written.startswith(e[1]))), None)
            if exception:
                exception[2] += 1
                excused += 1
                continue
            wrong += 1
            print(f"{name}:{line}: {count} words: {written}")
        for line, message in links(page):
            wrong += 1
            print(f"{name}:{line}: {message}")
    if not arguments:
        for name, beginning, used, number in exceptions:
            if not used:
                wrong += 1
                print(f"{ALLOWED.relative_to(ROOT)}:{number}: excuses nothing any more: {name}: {beginning}")
    if wrong:
        print(f"words: {wrong} to mend (sentences over {LIMIT} words, or links that lead nowhere)", file=sys.stderr)
        return 1
    print(f"words: {len(chosen)} pages, no sentence over {LIMIT} words ({excused} excused), all links lead somewhere")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
