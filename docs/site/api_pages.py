#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of the site that are made from code; build.sh calls it.

    api_pages.py headers                                      the headers that the rooms' CMakeLists.txt install
    api_pages.py pages FOLDER XML STUB.pyi FOLDER_OF_MODULE   writes FOLDER/cpp/*.rst, a page per room, with what doxygen
                                                              wrote into XML of these headers; and FOLDER/python.rst,
                                                              every name of the type stub in its order and groups, with
                                                              the docstrings of the compiled module
"""
import ast
import inspect
import re
import sys
from pathlib import Path
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parents[2]


def installed_headers():
    """{room: [header below src/]} in the order of the rooms."""
    rooms = {}
    order = re.findall(r"add_subdirectory\(src/hyperex/(\w+)\)", (ROOT / "CMakeLists.txt").read_text())
    for room in dict.fromkeys(order):
        text = (ROOT / f"src/hyperex/{room}/CMakeLists.txt").read_text()
        for block in re.findall(r"\bHEADERS\s+([^)]*?)(?=\s+(?:SOURCES|LINKS|PRIVATE_LINKS)\b|\))", text):
            rooms.setdefault(room, []).extend(f"hyperex/{room}/{header}" for header in block.split())
    return rooms


def title(text, line="="):
    return f"{text}\n{line * len(text)}\n\n"


def comment_of(lines, number):
    """The comment of what is declared in a line (from 1): behind it, or above it."""
    behind = re.search(r"///<\s?(.*)", lines[number - 1])
    if behind:
        words = [behind.group(1)]
        for line in lines[number:]:
            if not (more := re.match(r"\s*///<\s?(.*)", line)):
                break
            words.append(more.group(1))
        return "\n".join(words)
    words, at = [], number - 2
    while at >= 0 and re.match(r"\s*template\b", lines[at]):
        at -= 1
    while at >= 0 and (above := re.match(r"\s*///(?!<) ?(.*)", lines[at])):
        words.insert(0, above.group(1))
        at -= 1
    return "\n".join(words)


def plain(node):
    return " ".join("".join(node.itertext()).split()) if node is not None else ""


class Headers:
    """Declarations of headers, by doxygen's XML; their comments, by the headers themselves, whose lines it joins."""

    def __init__(self, xml):
        self.xml = xml
        self.lines = {}
        self.members = {}
        for file in sorted(xml.glob("namespace*.xml")):
            for member in ElementTree.parse(file).iter("memberdef"):
                self.members.setdefault(member.find("location").get("file"), []).append(member)
        self.files = {}
        for file in xml.glob("*_8hpp.xml"):
            compound = ElementTree.parse(file).find("compounddef")
            self.files[compound.find("location").get("file")] = compound
        self.written = set()

    def comment(self, location):
        file = location.get("file")
        if file not in self.lines:
            self.lines[file] = (ROOT / "src" / file).read_text().splitlines()
        return comment_of(self.lines[file], int(location.get("line")))

    def member(self, node, by, scope=""):
        kind, name = node.get("kind"), scope + plain(node.find("name"))
        comment = as_block(self.comment(node.find("location")), by + 3)
        start = plain(node.find("initializer"))
        static = "static " if node.get("static") == "yes" else ""
        if kind == "function":
            template = node.find("templateparamlist")
            parameters = [] if template is None else [
                " ".join(filter(None, (plain(p.find("type")), plain(p.find("declname"))))) for p in template.findall("param")]
            words = plain(node.find("argsstring"))
            words = re.sub(r"\s*=\s*(default|delete)$", r" = \1", words)
            text = f"{static}{plain(node.find('type'))} {name}{words}".strip()
            kind, text = "function", (f"template<{', '.join(parameters)}> " if parameters else "") + text
        elif kind == "variable":
            short = start if len(start) < 60 and "lambda" not in start else ""
            kind, text = "var", f"{static}{plain(node.find('type'))} {name}{plain(node.find('argsstring'))} {short}"
        elif kind == "typedef":
            definition = plain(node.find("definition"))
            kind = "type"
            text = f"{name} = {definition.split('=', 1)[1].strip().removeprefix('typedef ')}" if "=" in definition else name
        elif kind == "enum":
            kind = "enum-class" if node.get("strong") == "yes" else "enum"
            text = name
        else:
            return ""
        whole = (plain(node.find("qualifiedname")), kind, text)
        if whole in self.written:
            return ""
        self.written.add(whole)
        out = f"{' ' * by}.. cpp:{kind}:: {text}\n\n{comment}"
        for value in node.findall("enumvalue"):
            out += f"{' ' * (by + 3)}.. cpp:enumerator:: {plain(value.find('name'))}\n\n"
            remark = re.search(rf"\b{plain(value.find('name'))}\b[^/]*///<\s?(.*)",
                               "\n".join(self.lines[node.find("location").get("file")]))
            out += as_block(remark.group(1), by + 6) if remark else ""
        return out

    def compound(self, reference, by=0):
        node = ElementTree.parse(self.xml / f"{reference}.xml").find("compounddef")
        bases = ", ".join(f"public {plain(base)}" for base in node.findall("basecompoundref"))
        name = plain(node.find("compoundname"))
        if by:  # inside another one
            name = name.rpartition("::")[2]
        out = f"{' ' * by}.. cpp:{node.get('kind')}:: {name}{' : ' + bases if bases else ''}\n\n"
        out += as_block(self.comment(node.find("location")), by + 3)
        for member in node.iter("memberdef"):
            if member.get("prot") == "public" and not plain(member.find("name")).startswith(("operator==", "~")):
                out += self.member(member, by + 3)
        for inner in node.findall("innerclass"):
            if inner.get("prot") == "public":
                out += self.compound(inner.get("refid"), by + 3)
        return out

    def page_of(self, header):
        intro = []
        for line in (ROOT / "src" / header).read_text().split("#pragma once\n", 1)[1].splitlines():
            if not line.startswith("//"):
                break
            intro.append(line[2:].removeprefix(" "))
        out = as_block("\n".join(intro), 0)
        compounds = self.files[header].findall("innerclass")
        names = {plain(c) for c in compounds}
        for inner in compounds:  # those inside another one come with it
            if plain(inner).rpartition("::")[0] not in names:
                out += self.compound(inner.get("refid"))
        for member in self.members.get(header, []):
            scope = plain(member.find("qualifiedname")).rpartition("::")[0]
            if not plain(member.find("name")).startswith("operator=="):
                out += self.member(member, 0, scope + "::" if scope else "")
        if ".. cpp:" not in out:
            sys.exit(f"api_pages: doxygen found nothing in {header}")
        return out


def write_cpp(folder, rooms, xml):
    folder.mkdir(parents=True, exist_ok=True)
    headers_of = Headers(xml)
    index = [title("C++ API"),
             "The headers that are installed, by room. How they are used: :doc:`/docs/library`; what the rooms are: "
             ":doc:`/docs/architecture`.\n\n.. toctree::\n\n"]
    for room, headers in rooms.items():
        index.append(f"   {room}\n")
        page = [title(f"hyperex/{room}")]
        for header in headers:
            page.append(title(header.removeprefix(f"hyperex/{room}/"), "-"))
            page.append(f".. code-block:: cpp\n\n   #include <{header}>\n\n{headers_of.page_of(header)}")
        (folder / f"{room}.rst").write_text("".join(page))
    (folder / "index.rst").write_text("".join(index))


def indented(text, by):
    return "".join(f"{' ' * by}{line}".rstrip() + "\n" for line in text.splitlines())


def documentation(found):
    """The docstring without the signatures that pybind11 puts in front; as it stands, line by line."""
    text = inspect.getdoc(found) if found is not None else None
    if not text:
        return ""
    lines = [line for line in text.splitlines()
             if not re.match(r"(\d+\. )?\w+\(.*\)( -> .*)?$|Overloaded function\.$", line)]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines)).strip()


def escape(line):
    """A line as it is read; `code` stays code."""
    parts = re.split(r"`([^`\\]+)`", line)
    for k, part in enumerate(parts):
        if k % 2:
            parts[k] = f"``{part.strip()}``\\ "
        else:
            parts[k] = re.sub(r"([\\*`_|])", r"\\\1", part)
    return "".join(parts)


def as_block(text, by):
    """Words as they stand: paragraphs, and lines that belong together, as a line block."""
    if not text:
        return ""
    out = []
    for paragraph in text.split("\n\n"):
        escaped = [escape(line) for line in paragraph.splitlines()]
        if any(line.startswith("  ") for line in paragraph.splitlines()):
            out.append("\n".join(f"| {line}" for line in escaped))
        else:
            out.append("\n".join(line.strip() for line in escaped))
    return indented("\n\n".join(out), by) + "\n"


def signature(node):
    text = f"{node.name}({ast.unparse(node.args)})"
    return text + (f" -> {ast.unparse(node.returns)}" if node.returns else "")


def write_member(node, owner, page):
    name = getattr(node, "name", None)
    if isinstance(node, ast.FunctionDef):
        words = documentation(getattr(owner, name, None))
        marks = {ast.unparse(d) for d in node.decorator_list}
        if "property" in marks:
            page.append(f"   .. py:property:: {name}\n      :type: {ast.unparse(node.returns)}\n\n")
        elif any(mark.endswith(".setter") for mark in marks):
            return
        elif name == "__init__":
            return
        else:
            node.args.args = node.args.args[1:] if "staticmethod" not in marks else node.args.args
            again = "" if "overload" not in marks else "      :noindex:\n"
            page.append(f"   .. py:method:: {signature(node)}\n{again}\n")
            if name.startswith("__"):
                words = ""
        page.append(as_block(words, 6))
    elif isinstance(node, ast.AnnAssign):
        name = node.target.id
        page.append(f"   .. py:attribute:: {name}\n      :type: {ast.unparse(node.annotation)}\n\n")
        page.append(as_block(documentation(getattr(owner, name, None)), 6)
                    if isinstance(getattr(owner, name, None), property) else "")


def write_python(file, stub, module):
    text = stub.read_text()
    groups = {number: match.group(1) for number, line in enumerate(text.splitlines(), 1)
              if number > 3 and (match := re.match(r"# (.+)", line))}
    page = [title("Python API"),
            ".. py:module:: hyperex\n\nThe names of ``import hyperex``, made from the module's type stub and its "
            "docstrings. How they are used, with programs: :doc:`/docs/python`. Arrays are NumPy's, in SI units.\n\n"]
    seen = set()
    for node in ast.parse(text).body:
        for number in [n for n in groups if n < node.lineno]:
            page.append(title(groups.pop(number), "-"))
        if isinstance(node, ast.FunctionDef):
            again = "   :noindex:\n" if node.name in seen else ""
            page.append(f".. py:function:: {signature(node)}\n{again}\n")
            page.append("" if node.name in seen else as_block(documentation(getattr(module, node.name, None)), 3))
            seen.add(node.name)
        elif isinstance(node, ast.ClassDef):
            owner = getattr(module, node.name, None)
            init = next((n for n in node.body if isinstance(n, ast.FunctionDef) and n.name == "__init__"), None)
            arguments = ""
            if init:
                init.args.args = init.args.args[1:]
                arguments = f"({ast.unparse(init.args)})"
            kind = "exception" if issubclass(owner, Exception) else "class"
            page.append(f".. py:{kind}:: {node.name}{arguments}\n\n")
            page.append(as_block(documentation(owner), 3))
            for member in node.body:
                write_member(member, owner, page)
    file.write_text("".join(page))


def main(arguments):
    rooms = installed_headers()
    if arguments == ["headers"]:
        print(" ".join(f"src/{header}" for headers in rooms.values() for header in headers))
    elif len(arguments) == 5 and arguments[0] == "pages":
        folder, xml, stub, module = map(Path, arguments[1:])
        write_cpp(folder / "cpp", rooms, xml)
        sys.path.insert(0, str(module))
        import hyperex
        write_python(folder / "python.rst", stub, hyperex)
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
