# SPDX-License-Identifier: Apache-2.0
"""programs.py SOURCE: tools/debian.txt lists every program that scripts, CMake files and tests call.

Without that a program counts on what a machine happens to have (make, once). Finds calls by their form: the first word of
a shell command, find_program and COMMAND of CMake, a literal that a test's helper runs. A program that is listed
and never named is an error, too."""
import os
import re
import sys

BUILTINS = set("""alias break case cd command continue do done echo elif else esac eval exec exit export false fi for function getopts
 if in kill local mapfile printf pwd read return set shift source test then time times trap true type ulimit umask unset until wait while""".split())
WRAPPERS = {"!", "if", "then", "else", "elif", "do", "while", "until", "time", "exec", "env", "nice", "xargs", "sudo", "timeout"}
PROGRAM = re.compile(r"[a-z][a-z0-9_+.-]*")
# Programs started by another program: `verilator --build` and `--binary` run make; CMake finds the others itself.
CALLED_BY = {"make": r"verilator\b.*--(build|binary)\b|VERILATOR\}.*--(build|binary)\b", "g++": r"(?m)^project\(", "pkg-config": r"find_package\(PkgConfig"}
# Programs started by C++ and Python: the first word of the literal after the function that starts it.
STARTS = re.compile(r"\b(?:run_words|start_daemon|client|in_path|system|popen|output_of|Popen|subprocess\.run)"
                    r"\(?\s*[\[{(]\s*[{\[]?\"(?:[^\"]*command -v )?([a-z][a-z0-9_+.-]*)[\" ]")


def plain_shell(text):
    """Without comments, quoted text, here-documents, arithmetic, arrays and patterns of `case`; what $( ) holds stays, on lines of its own."""
    text = re.sub(r"<<-?'?(\w+)'?[^\n]*\n.*?\n\1(?=\n)", "", text, flags=re.S)
    text = re.sub(r"\$'(?:[^'\\]|\\.)*'", "''", text.replace("\\\n", " "))
    out, quotes, i = [], [False], 0  # one entry per level of $( ): whether it is inside double quotes
    while i < len(text):
        inside, rest = quotes[-1], text[i:i + 3]
        if rest[0] == "\\":
            i += 1
        elif rest[0] == "'" and not inside:
            i = text.index("'", i + 1)

            out.append("''")
        elif rest[0] == '"':
            quotes[-1] = not inside
            out.append("''")
        elif rest[0] == "#" and not inside and (i == 0 or text[i - 1].isspace()):
            i = text.find("\n", i) - 1
        elif (rest == "$((" or rest[:2] == "((" and not inside) and "))" in text[i:]:
            i = text.index("))", i) + 1
            out.append("0")
        elif rest[:2] in ("$(", "<(", ">("):
            quotes.append(False)
            out.append("''\n")
            i += 1
        elif rest[0] == "(" and not inside:
            quotes.append(False)
            out.append("(")
        elif rest[0] == ")" and not inside:
            if len(quotes) > 1:
                quotes.pop()
            out.append(" )\n" if i and text[i - 1] != "(" else ")")
        elif not inside:
            out.append(rest[0])
        i += 1
    text = re.sub(r"\w+\+?=\([^)]*\)", "", "".join(out))
    return re.sub(r"(?m)(^|\bin|;;)[\w.*?|\[\]'+ /-]*\s\)$", r"\1", text)


def shell_calls(text):
    text = plain_shell(text)
    called = set()
    for command in re.split(r"\|\||&&|[|;&{(\n]", text):
        words = command.split()
        while words and (words[0] in WRAPPERS or re.match(r"\w+=|-|[0-9]", words[0])):
            words.pop(0)
        if words[:2] == ["command", "-v"]:
            words = words[2:]
        if words and PROGRAM.fullmatch(words[0]):
            called.add(words[0])
    return called, set(re.findall(r"(?m)^\s*(\w+)\(\)", text))


def calls_of(name, text):
    """Programs called, and functions defined, in one file."""
    if re.match(r"#!.*sh\b", text) or name.endswith((".sh", ".bash")):
        return shell_calls(text)
    if name.endswith("CMakeLists.txt") or name.endswith(".cmake"):
        text = re.sub(r"(?m)#.*$", "", text)
        words = re.findall(r"\b(?:COMMAND\s+|find_program\(\w+\s+)([a-z][\w+.-]*)", text)
        return set(words), set(re.findall(r"\badd_executable\((\w+)", text))  # targets of ours are called as functions are
    if name.endswith((".cpp", ".hpp", ".py")):
        return set(STARTS.findall(text)), set()
    return set(), set()


source = sys.argv[1]
listed = {}
with open(f"{source}/tools/debian.txt") as file:
    for line in file:
        if line[:1].strip() and line[0] not in "#[":
            package, *programs = line.removeprefix("?").split()
            listed.update(dict.fromkeys(programs, package))
called, functions, words = {}, set(), set()
for folder, folders, files in os.walk(source):
    folders[:] = [f for f in folders if not f.startswith("build") and f not in (".git", "demo", "out", "node_modules")]
    for file in files:
        path = os.path.join(folder, file)
        try:
            with open(path, encoding="utf-8") as opened:
                text = opened.read()
        except (UnicodeDecodeError, FileNotFoundError):
            continue
        if file.endswith((".py", ".sh", ".cpp", ".hpp", ".mjs", ".txt", ".cmake", ".json")) and path != os.path.abspath(__file__) or text.startswith("#!"):
            if file != "debian.txt":
                words.update(re.findall(r"[a-z0-9][a-z0-9_+-]*", text))
            programs, defined = calls_of(file, text)
            functions |= defined
            for program in programs:
                called.setdefault(program, os.path.relpath(path, source))
            for program, form in CALLED_BY.items():
                if re.search(form, text):
                    called.setdefault(program, os.path.relpath(path, source))
wrong = [f"{where}: calls {program}, which tools/debian.txt does not list"
         for program, where in sorted(called.items()) if program not in listed and program not in BUILTINS | functions]
wrong += [f"tools/debian.txt: nothing names {program} of {package}" for program, package in listed.items() if program not in words | set(called)]
print(f"[figure] programs called = {len(set(called) & set(listed))} (limit > 40), not listed or never named = {len(wrong)} (limit 0)")
print("\n".join(wrong))
sys.exit(1 if wrong or len(set(called) & set(listed)) <= 40 else 0)
