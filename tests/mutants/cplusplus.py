"""Mutants of one C++ source, all in one text: `::fastsplat_mutants::is(N) ? mutant : original`.

Whole expressions of statements and conditions, where clang-format's spaces tell a comparison from a template; what the small
grammar does not know (lambdas, braces) stays as it is. constexpr and static declarations, and text put together, are left alone."""
import variants
from expression import Node, Parser, Unreadable
from systemverilog import Mutant
from tokens import closing, joined, tokens_of

PRELUDE = '#include "tests/mutants/selected.hpp"\n'
_STATEMENT_ENDS = {";", "{", "}", ")", "else"}
_ASSIGNMENTS = {"=", "+=", "-=", "*=", "|=", "&=", "^=", "<<=", ">>="}


class CppParser(Parser):
    def is_binary(self, operators) -> bool:
        if not super().is_binary(operators):
            return False
        token = self.tokens[self.at]
        spaced = self.tokens[self.at - 1].end < token.start and token.end < self.tokens[self.at + 1].start
        return spaced

    def unary(self) -> Node:
        start = self.at
        if self.peek() in ("*", "&", "++", "--"):
            self.at += 1
            inner = self.unary()
            return self.node("text", start, [inner] if self.tokens[start].text == "*" else [])
        return super().unary()

    def primary(self) -> Node:
        start = self.at
        if start >= self.end:
            raise Unreadable("nothing left")
        token = self.tokens[start]
        if token.kind == "string":
            while self.at < self.end and self.tokens[self.at].kind == "string":
                self.at += 1
            return self.node("text", start)
        if token.text == "::" or (token.kind == "name" and token.text not in ("new", "delete", "sizeof", "throw")):
            if token.text == "::":
                self.at += 1
            self.at += 1
            self._template()
            while self.peek() == "::":
                self.at += 2
                self._template()
            if self.peek() == "{":
                self.at = closing(self.tokens, self.at) + 1
                return self.postfix(self.node("text", start))
            return self.postfix(self.node("name", start))
        if token.kind == "number" or token.text == "(":
            return super().primary()
        raise Unreadable(f"no primary: {token.text!r}")

    def _template(self):
        """Its arguments belong to the name before them: no space, as clang-format has it."""
        if self.peek() != "<" or self.tokens[self.at - 1].end < self.tokens[self.at].start or self.tokens[self.at].end < self.tokens[self.at + 1].start:
            return
        depth = 0
        for i in range(self.at, self.end):
            depth += {"<": 1, ">": -1, ">>": -2}.get(self.tokens[i].text, 0)
            if depth <= 0:
                self.at = i + 1
                return
        raise Unreadable("template without end")

    def postfix(self, node: Node) -> Node:
        start, children = node.start, list(node.children)
        simple = node
        while True:
            if self.peek() in (".", "->"):
                self.at += 2
                self._template()
            elif self.peek() == "(":
                self.at += 1
                children += self.arguments(")")
            elif self.peek() == "[":
                self.at += 1
                children.append(self.ternary())
                self.take("]")
            elif self.peek() in ("++", "--"):
                self.at += 1
            else:
                return simple if self.at == simple.end else self.node("text", start, children)


class CppMutator:
    def __init__(self, module: str, file: str, source: str, number: int, wanted=lambda module, number: True):
        self.module, self.file, self.source, self.number, self.wanted = module, file, source, number, wanted
        self.lines = source.split("\n")
        self.tokens = tokens_of(source, "cplusplus")
        self.mutants: list[Mutant] = []
        self.edits: list[tuple[int, int, str]] = []

    def result(self) -> str:
        self._scan()
        out, at = [], 0
        for start, end, text in sorted(self.edits):
            out += [self.source[at:start], text]
            at = end
        return PRELUDE + '#line 1\n' + "".join(out) + self.source[at:]

    def _add(self, line, what, original, text):
        self.number += 1
        if not self.wanted(self.module, self.number - 1):
            return None
        source = " ".join(self.lines[line - 1].split())
        mutant = Mutant(self.number - 1, self.module, line, source, what, original, text)
        mutant.file = self.file
        self.mutants.append(mutant)
        return mutant.number

    def _choice(self, node: Node, found, original: str) -> str:
        out, seen = "", {node.text}
        for what, text in found:
            if text in seen:
                continue
            seen.add(text)
            number = self._add(node.line, what, node.text, text)
            if number is not None:
                out += f"::fastsplat_mutants::is({number}) ? ({text}) : "
        return f"({out}({original}))" if out else original

    def _mutate(self, node: Node, extra=()) -> str:
        found = list(extra)
        if node.kind == "binary":
            op = node.parser.tokens[node.op].text
            found += [v for v in variants.binary_variants(node) if not (op in ("==", "!=") and v[0].split()[-1] not in ("==", "!="))]
            if op in ("&&", "||"):  # a side alone may be anything that can be asked for its truth
                found = [(what, f"static_cast<bool>({text})" if what.startswith("without its") else text) for what, text in found]
        elif node.kind == "unary" and node.parser.tokens[node.op].text in ("!", "-"):
            found += variants.unary_variants(node)
        elif node.kind == "ternary":
            found += variants.ternary_variants(node)
        elif node.kind == "number" and node.text.rstrip("uUlL").isdigit():
            digits = node.text.rstrip("uUlL")
            suffix = node.text[len(digits):]
            found += [(f"{node.text} becomes {text}{suffix}", text + suffix) for _, text in variants.number_variants(digits)]
        return self._choice(node, found, node.with_children({child: self._mutate(child) for child in node.children}))

    def _expression(self, start: int, end: int, extra=lambda node: [], bare=False):
        """That of tokens[start:end], where it can be read. A number alone is left: it may be what a constant is made of."""
        tokens = self.tokens[start:end]
        if start >= end or any(t.kind == "string" or t.text in ("{", "to_string", "format") or t.text.startswith("str") for t in tokens):
            return
        parser = CppParser(self.tokens, start, end)
        try:
            node = parser.ternary()
        except (Unreadable, IndexError):
            return
        if parser.at != end or (node.kind == "number" and not bare):
            return
        before = len(self.mutants)
        text = self._mutate(node, extra(node))
        if len(self.mutants) > before:
            self.edits.append((self.tokens[start].start, self.tokens[end - 1].end, text))

    def _scan(self):
        """Statements of function bodies: what follows a `{`, `}`, `;`, `)` or else."""
        i, stop = 0, len(self.tokens)
        while i < stop:
            text, before = self.tokens[i].text, self.tokens[i - 1].text if i else ";"
            if text in ("if", "while") and i + 1 < stop and self.tokens[i + 1].text == "(":
                end = closing(self.tokens, i + 1)
                inside = [t.text for t in self.tokens[i + 2:end]]
                if ";" not in inside and "=" not in inside:
                    self._expression(i + 2, end, lambda n: variants.condition_variants(n, "true", "false") if text == "if" else [])
                i = end
            elif text == "for" and self.tokens[i + 1].text == "(":
                end = closing(self.tokens, i + 1)
                parts = [k for k in range(i + 2, end) if self.tokens[k].text == ";"]
                if len(parts) == 2:
                    self._expression(parts[0] + 1, parts[1])
                i = end
            elif text == "return":
                end = self._semicolon(i)
                if end is not None:
                    self._expression(i + 1, end)
                    i = end
            elif before in _STATEMENT_ENDS and self.tokens[i].kind == "name":
                i = self._statement(i)
            i += 1

    def _semicolon(self, i: int):
        """Index of the statement's end, None if a block comes first."""
        while i < len(self.tokens):
            text = self.tokens[i].text
            if text == ";":
                return i
            if text in ("}", ":") and self.tokens[i].kind == "operator" and text == "}":
                return None
            i = closing(self.tokens, i) + 1 if text in ("(", "[", "{") else i + 1
        return None

    def _statement(self, i: int) -> int:
        end = self._semicolon(i)
        if end is None or self.tokens[i].text in ("constexpr", "static", "using", "namespace", "template", "struct", "class", "enum",
                                                  "throw", "case", "default", "break", "continue", "inline", "else", "extern", "friend"):
            return i
        at = next((k for k in range(i, end) if self.tokens[k].text in _ASSIGNMENTS), None)
        if at is not None and "(" not in [t.text for t in self.tokens[i:at]] and "{" not in [t.text for t in self.tokens[i:end]]:
            declares = self.tokens[at].text == "=" and self.tokens[at - 1].kind == "name" and at - i > 1 and (
                self.tokens[at - 2].kind == "name" or self.tokens[at - 2].text in (">", "&", "*"))
            self._expression(at + 1, end, bare=not declares)
            if not declares:
                self._drop(i, end)
            return end
        if self.tokens[i + 1].text in (".", "->", "(", "[", "++", "--") and "{" not in [t.text for t in self.tokens[i:end]]:
            self._drop(i, end)
        return i

    def _drop(self, start: int, end: int):
        number = self._add(self.tokens[start].line, "dropped", joined(self.tokens[start:end]), "")
        if number is None:
            return
        at, close = self.tokens[start].start, self.tokens[end].end
        self.edits.append((at, at, f"{{ if (!::fastsplat_mutants::is({number})) "))
        self.edits.append((close, close, " }"))
