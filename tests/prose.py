# SPDX-License-Identifier: Apache-2.0
"""prose.py SOURCE PROGRAM [--record]: pages and comments read plainly, links resolve, commands exist.

Counts per folder, in pages and header comments: sentences of more than 35 words, table cells of more than 25, wordings that
the style bans, dead links, and commands that the programs' own --help does not list; bodies: banned wordings in comments of
all other sources. tests/prose.txt holds the accepted counts. A count above its ceiling is an error; so is one below it, until
the ceiling is lowered: --record does that, and never raises one.
Code, quoted text and generated JSON keys are not prose."""
import collections
import os
import re
import subprocess
import sys

KINDS = ["sentences", "cells", "wordings", "links", "commands", "bodies"]
SENTENCE, CELL = 35, 25  # words at most
WORDINGS = re.compile(r"\bis no (?!longer\b)|\bare none\b| told\b|\bthose that\b", re.IGNORECASE)
BODIES = re.compile(r"(?<!there )\bis no(?:ne\b| (?!longer\b|later\b|less\b|more\b))|(?<!there )\bare none\b|\btells?\b| told\b|\bthose that\b|\bwhoever\b", re.IGNORECASE)
COMMENTS = {".cpp": "//", ".sv": "//", ".svh": "//", ".def": "//", ".c": "//", ".h": "//", ".ts": "//", ".mjs": "//", ".sh": "#", ".py": "#"}
COMMAND = re.compile(r"(?m)(?:^|[|;&($])\s*(?:\w+=\S+ +)*((?:\./run|(?:[\w./]*/)?fastsplat|tools/[a-z-]+)(?= |$)[^|;&>\n#]*)")
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(<?([^)\s>]+)>?\)")
PAGE = re.compile(r"\bdocs/[\w/-]+\.md\b")
SECTION = re.compile(r"([\w/-]+\.md)\)?,? \(?(?:section [\d.]+, )?\"([A-Z0-9][^\"]{2,60})\"")  # PAGE.md, "Section"


def words(text):
    return sum(any(c.isalnum() for c in word) for word in text.split())


def plain(text):
    """Without code, quotes and targets of links: each becomes one word."""
    text = re.sub(r"(`+)(?:(?!\1).)+\1", "Code", text, flags=re.S)
    text = LINK.sub(lambda m: "" if m[1] else m[2], text)
    text = re.sub(r"<!--.*?-->|</?[a-z][^>]*>", "", text, flags=re.S)
    text = re.sub(r"\$\$?[^$]+\$\$?", "Formula", text)
    return re.sub(r'"[^"]{1,200}"', "Quote", text)


def sentences(paragraph):
    return re.split(r"(?<=[.!?])[\"”)*_]*\s+(?=[^a-z\s])", paragraph)


def prose_defects(paragraph, line):
    text = " ".join(plain(paragraph).split())
    for sentence in sentences(text):
        if words(sentence) > SENTENCE:
            yield "sentences", line, f"{words(sentence)} words, limit {SENTENCE}: {sentence[:70]} ..."
    for match in WORDINGS.finditer(text):
        yield "wordings", line, f'"{match[0].strip()}": {text[max(0, match.start() - 30):match.end() + 30]}'


class Page:
    """A Markdown page in parts: paragraphs, rows of tables, code and anchors, each part with its line."""

    def __init__(self, text):
        self.paragraphs, self.cells, self.code, self.anchors, self.seen = [], [], [], set(), collections.Counter()
        self.twice = []
        self.titles = " ".join(re.findall(r"(?m)^#+ .*|\*[^*\n]+\*", text))
        self.links, block, fence, in_list, listing = [], [], None, False, ""
        for number, line in enumerate(text.splitlines() + [""], 1):
            bare = line.strip()
            fence_line = re.match(r" *(```|~~~)", line)
            if fence or fence_line:
                if fence and fence_line:
                    self.code.append((listing, fence))
                    fence = None
                elif fence:
                    listing += line + "\n"
                else:
                    self.close(block)
                    fence, listing = number, ""
                continue
            if re.match(r" {4}", line) and not block and not in_list:
                self.code.append((line, number))
                continue
            heading = re.match(r"#+ +(.*)", line)
            item = re.match(r"\s*([-*+]|\d+\.) ", line)
            if not bare or heading or item or bare.startswith("|"):
                self.close(block)
            if heading:
                self.heading(heading[1], number)
            elif bare.startswith("|"):
                self.row(bare, number)
            elif bare:
                block.append((line[item.end():] if item else re.sub(r"^> ?", "", line), number))
            in_list = bool(item) or in_list and (not bare or line.startswith(" "))
            for anchor in re.findall(r"<a (?:id|name)=\"([^\"]+)\"", line):
                if anchor in self.anchors:
                    self.twice.append((anchor, number))
                self.anchors.add(anchor)
        self.paragraphs = [(text, line) for text, line in self.paragraphs if not text.startswith("<!--")]

    def close(self, block):
        if block:
            self.span("\n".join(line for line, _ in block), block[0][1])
            self.paragraphs.append(("\n".join(line for line, _ in block), block[0][1]))
            block.clear()

    def span(self, text, line):
        self.code += [(code[1], line) for code in re.findall(r"(`+)((?:(?!\1).)+)\1", text, flags=re.S)]
        outside = re.sub(r"(`+)(?:(?!\1).)+\1", "", text, flags=re.S)
        self.links += [(match[3], line) for match in LINK.finditer(outside)]

    def heading(self, text, line):
        self.span(text, line)
        text = LINK.sub(r"\2", text.replace("`", ""))
        name = re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")
        self.anchors.add(name + (f"-{self.seen[name]}" if self.seen[name] else ""))
        self.seen[name] += 1

    def row(self, row, line):
        self.span(row, line)
        hidden = re.sub(r"`[^`]*`", "Code", row).replace(r"\|", "")
        self.cells += [(cell, line) for cell in hidden.strip("|").split("|")]


class Help:
    """What the programs say of themselves, each asked once."""

    def __init__(self, source, program):
        self.source, self.program, self.texts = source, program, {}

    def text(self, *command):
        if command not in self.texts:
            ran = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, cwd=self.source,
                                 text=True, errors="replace", check=False)
            self.texts[command] = ran.stdout if ran.returncode == 0 else None
        return self.texts[command]

    def defect(self, shown):
        """Why this command does not exist; None if it does."""
        program, *rest = [word.strip("[]()'\",:").rstrip(".") for word in shown.split()]
        names = [word for word in rest if re.fullmatch(r"[a-z][a-z-]*", word)]
        if program == "./run" and names[:1] == ["fastsplat"]:
            program, rest, names = "fastsplat", rest[1:], names[1:]
        first = rest[0] if rest else ""
        if program.endswith("fastsplat"):
            about = self.text(self.program, "help")
            if first == "help":
                return None
            if names and first == names[0]:
                about = self.text(self.program, first, "--help")
                if about is None:
                    return f"no subcommand {first}"
                if re.search(r"^Subcommands:", about, re.M) and len(rest) > 1 and rest[1] in names:
                    about = self.text(self.program, first, rest[1], "--help")
                    if about is None:
                        return f"no subcommand {first} {rest[1]}"
        elif program == "./run":
            about = self.text("./run", "help")
            if names and first == names[0] and first != "help":
                if not re.search(rf"^\./run {first}\b", about, re.M):
                    return f"./run has no command {first}"
                about = self.text("./run", first, "--help")
        else:
            if os.path.isdir(f"{self.source}/{program}"):
                return None
            about = self.text(program, "--help") if os.access(f"{self.source}/{program}", os.X_OK) else None
            if about is None:
                return f"no script {program}"
        for word in rest:
            flag = re.match(r"--[a-z][\w-]*|-[A-Za-z](?=$|\d)", word)
            if flag and flag[0] != "--help" and not re.search(rf"(?<![\w-]){flag[0]}(?![a-z-])", about):
                if not re.match(r"--benchmark_", word):
                    return f"{shown.split(' --')[0]} has no flag {flag[0]}"
        return None


def section_defects(text, line, pages):
    for name, title in SECTION.findall(" ".join(text.split())):
        page = pages.get(name) or pages.get("docs/" + name)
        if page and title not in page.titles:
            yield "links", line, f'{name}, "{title}": no such section'


def page_defects(path, pages, programs, source):
    page = pages[path]
    for text, line in page.paragraphs:
        yield from prose_defects(text, line)
        yield from section_defects(text, line, pages)
    for cell, line in page.cells:
        text = plain(cell)
        if words(text) > CELL:
            yield "cells", line, f"{words(text)} words, limit {CELL}: {text.strip()[:70]} ..."
        for match in WORDINGS.finditer(text):
            yield "wordings", line, f'"{match[0].strip()}": {text.strip()[:70]}'
    for target, line in page.links:
        if re.match(r"[a-z]+:", target):
            continue
        file, _, anchor = target.partition("#")
        where = os.path.normpath(os.path.join(os.path.dirname(path), file)) if file else path
        if not os.path.exists(os.path.join(source, where)):
            yield "links", line, f"{target}: no such file"
        elif anchor and where in pages and anchor not in pages[where].anchors:
            yield "links", line, f"{target}: {where} has no such heading"
    for anchor, line in page.twice:
        yield "links", line, f"{anchor}: a second anchor of this name"
    for code, line in page.code:
        for match in COMMAND.finditer(re.sub(r"\\\n", " ", code)):
            why = programs.defect(match[1])
            if why:
                yield "commands", line, f"{match[1].strip()}: {why}"


def header_defects(text, pages, source):
    block = []
    for number, line in enumerate(text.splitlines() + [""], 1):
        comment = re.match(r"\s*//[/!]?<?(.*)", line)
        said = comment[1] if comment else ""
        if block and (not said.strip() or re.match(r" ?\s*[-*] ", said)):
            joined = "\n".join(line for line, _ in block)
            yield from prose_defects(joined, block[0][1])
            yield from section_defects(joined, block[0][1], pages)
            block = []
        if said.strip() and not said.startswith("    "):
            block.append((re.sub(r"^\s*[-*] ", "", said), number))
            for page in PAGE.findall(said):
                if not os.path.exists(f"{source}/{page}"):
                    yield "links", number, f"{page}: no such file"


def body_defects(text, mark):
    """Comments of sources that are not headers, on their own lines or behind code."""
    block = []
    for number, line in enumerate(text.splitlines() + [""], 1):
        own = re.match(rf"\s*{mark}[/#!]?<? ?(.*)", line)
        behind = None if own else re.search(rf"\s{mark}<? (.*)", line)
        if not own and block:
            joined = " ".join(" ".join(line for line, _ in block).split())
            for match in BODIES.finditer(plain(joined)):
                yield "bodies", block[0][1], f'"{match[0].strip()}": {plain(joined)[max(0, match.start() - 30):match.end() + 30]}'
            block = []
        if own:
            block.append((own[1], number))
        elif behind and line[:behind.start()].count('"') % 2 == 0:
            for match in BODIES.finditer(plain(behind[1])):
                yield "bodies", number, f'"{match[0].strip()}": {behind[1][:70]}'


def files_of(source):
    for folder, folders, files in os.walk(source):
        here = os.path.relpath(folder, source)
        folders[:] = sorted(f for f in folders if not (here == "." and re.match(r"build|demo$|out$|third_party$", f)) and f not in (".git", "node_modules"))
        for file in sorted(files):
            path = os.path.normpath(os.path.join(here, file))
            # The prefaces of generated pages are read where they stand in those pages.
            if path.endswith((".hpp", *COMMENTS)) or path.endswith(".md") and not path.startswith("tools/pages/"):
                yield path


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def folder_of(path):
    folder = os.path.dirname(path)
    return folder if folder.startswith("docs") else folder.split("/")[0] or "."


def count(source, program):
    texts = {path: read(os.path.join(source, path)) for path in files_of(source)}
    pages = {path: Page(text) for path, text in texts.items() if path.endswith(".md")}
    programs, found = Help(source, program), collections.defaultdict(list)
    for path, text in texts.items():
        if path in pages:
            defects = page_defects(path, pages, programs, source)
        elif path.endswith(".hpp"):
            defects = header_defects(text, pages, source)
        else:
            defects = body_defects(text, COMMENTS[os.path.splitext(path)[1]])
        for kind, line, what in defects:
            found[folder_of(path), kind].append(f"{path}:{line}: {kind}: {what}")
    return found, sorted({folder_of(path) for path in texts}), len(pages), sum(path.endswith(".hpp") for path in texts), sum(path.endswith((*COMMENTS,)) for path in texts)


def ceilings(path):
    rows = [line.split() for line in read(path).splitlines() if line.strip() and line[0] != "#"]
    return {row[0]: dict(zip(KINDS, map(int, row[1:]))) for row in rows}


def record(path, found, folders, accepted):
    head = [line for line in read(path).splitlines() if line.startswith("#")]
    rows = []
    for folder in folders:
        now = [min(len(found[folder, kind]), accepted.get(folder, {}).get(kind, sys.maxsize)) for kind in KINDS]
        rows.append(f"{folder:18}" + "".join(f"{n:10}" for n in now))
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(head + rows) + "\n")


def main(source, program, *flags):
    kept = os.path.join(source, "tests/prose.txt")
    found, folders, pages, headers, bodies = count(source, program)
    if "--list" in flags:
        print("\n".join(line for lines in found.values() for line in lines))
    if "--record" in flags:
        record(kept, found, folders, ceilings(kept))
    accepted, wrong = ceilings(kept), 0
    for folder in sorted(set(folders) | set(accepted)):
        for kind in KINDS:
            now, limit = len(found[folder, kind]), accepted.get(folder, {}).get(kind, 0)
            if now > limit:
                wrong += 1
                print(f"{folder}: {kind}: {now}, ceiling {limit}. Rewrite some of:", *found[folder, kind], sep="\n  ")
            elif now < limit:
                wrong += 1
                print(f"{folder}: {kind}: {now}, ceiling {limit}. Lower it: python3 tests/prose.py . build/bin/fastsplat --record")
    for kind in KINDS:
        print(f"[figure] {kind} = {sum(len(found[folder, kind]) for folder in folders)} (limit {sum(a[kind] for a in accepted.values())})")
    print(f"[figure] pages read = {pages}, headers = {headers}, other sources = {bodies} (limit > 0)")
    return 1 if wrong or not pages or not headers or not bodies else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
