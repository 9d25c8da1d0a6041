# SPDX-License-Identifier: Apache-2.0
"""Mutants of one C++ source, all in one text: `::fastsplat_mutants::is(N) ? mutant : original`.

Whole expressions of statements and conditions in bodies of functions, where clang-format's spaces tell a comparison from a template; what
the small grammar does not know (lambdas, braces) stays as it is. constexpr and static declarations, and text put together, are left alone."""
import variants
from expression import Node, Parser, Unreadable
from systemverilog import Mutant
from tokens import closing, joined, tokens_of

PRELUDE = '#include "tests/mutants/selected.hpp"\n'
_STATEMENT_ENDS = {";", "{", "}", ")", "else"}
_NO_STATEMENT = {"constexpr", "static", "static_assert", "using", "namespace", "template", "struct", "class", "enum", "union", "throw", "case",
                 "default", "break", "continue", "inline", "else", "extern", "friend", "do", "try", "catch", "switch", "public", "private",
                 "protected", "typedef", "co_return", "goto"}
_NO_BODY = {"struct", "class", "enum", "union", "namespace", "concept"}
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
    def __init__(self, module: str, file: str, source: str, number: int, wanted=lambda name: True):
        self.module, self.file, self.source, self.number, self.wanted = module, file, source, number, wanted
        self.lines = source.split("\n")
        self.tokens = tokens_of(source, "cplusplus")
        self.mutants: list[Mutant] = []
        self.edits: list[tuple[int, int, str]] = []
        self.same: dict = {}
        self.bodies = self._bodies()

    def result(self) -> str:
        self._scan()
        out, at = [], 0
        for start, end, text in sorted(self.edits):
            out += [self.source[at:start], text]
            at = end
        return PRELUDE + '#line 1\n' + "".join(out) + self.source[at:]

    def _add(self, line, what, original, text):
        """Its number if it is wanted. The second of the same on a line says so: (2)."""
        self.number += 1
        same = self.same[(line, what, original)] = self.same.get((line, what, original), 0) + 1
        what += f" ({same})" if same > 1 else ""
        source = " ".join(self.lines[line - 1].split())
        if not self.wanted(f"{self.file}: {source}: {what}: {original}"):
            return None
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
        if any(what in ("always", "never", "negated", "without !") for what, _ in found):
            original = f"static_cast<bool>({original})"
        return f"({out}({original}))" if out else original

    def _mutate(self, node: Node, extra=()) -> str:
        found = list(extra)
        if node.kind == "binary":
            op = node.parser.tokens[node.op].text
            found += [v for v in variants.binary_variants(node) if not (op in ("==", "!=") and v[0].split()[-1] not in ("==", "!="))]
            if any(child.text.endswith(("begin()", "end()")) for child in node.children):  # places have no sum, and may have no order
                found = [v for v in found if v[0] != "- becomes +"]
            if op in ("&&", "||"):  # a side alone may be anything that can be asked for its truth
                found = [(what, f"static_cast<bool>({text})" if what.startswith("without its") else text) for what, text in found]
        elif node.kind == "unary" and node.parser.tokens[node.op].text in ("!", "-"):
            found += [(what, f"static_cast<bool>{text}" if what == "without !" else text) for what, text in variants.unary_variants(node)]
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

    def _bodies(self) -> list[tuple[int, int]]:
        """(first token, the brace that ends it) of each function's body that is in no other."""
        out, i, begun = [], 0, 0
        while i < len(self.tokens):
            text = self.tokens[i].text
            if text == "(" or text == "[":
                i = closing(self.tokens, i)
            elif text in (";", "}"):
                begun = i + 1
            elif text == "{":
                if self._is_body(begun, i):
                    end = closing(self.tokens, i)
                    if self.tokens[end + 1].text == "{":  # it was a member's value
                        begun = i = end
                    else:
                        out.append((i, end))
                        begun, i = end + 1, end
                else:
                    begun = i + 1
            i += 1
        return out

    def _is_body(self, begun: int, brace: int) -> bool:
        while begun < brace and self.tokens[begun].text == "template":
            depth, begun = 0, begun + 1
            while begun < brace:
                depth += {"<": 1, ">": -1, ">>": -2}.get(self.tokens[begun].text, 0)
                begun += 1
                if depth <= 0:
                    break
        before = self.tokens[begun:brace]
        if any(t.text == "consteval" for t in before):
            return False
        if not before or before[0].text in _NO_BODY or any(t.text == "=" for t in before if t.kind == "operator"):
            return any(t.text == "operator" for t in before)
        return any(t.text == "(" for t in before)

    def _scan(self):
        for start, end in self.bodies:
            self._body(start, end)

    def _body(self, i: int, stop: int):
        """Its statements: what follows a `{`, `}`, `;`, `)` or else."""
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
            elif before in _STATEMENT_ENDS and self.tokens[i].kind == "name" and self.tokens[i - 2].text != "void":
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
        if end is None or self.tokens[i].text in _NO_STATEMENT:
            return i
        at = next((k for k in range(i, end) if self.tokens[k].text in _ASSIGNMENTS), None)
        if at is not None and "(" not in [t.text for t in self.tokens[i:at]] and "{" not in [t.text for t in self.tokens[i:end]]:
            declares = self.tokens[at].text == "=" and (self.tokens[i].text in ("const", "auto") or (
                self.tokens[at - 1].kind == "name" and at - i > 1 and (
                    self.tokens[at - 2].kind == "name" or self.tokens[at - 2].text in (">", "&", "*"))))
            self._expression(at + 1, end, bare=not declares)
            if not declares:
                self._drop(i, end)
            return end
        call = i + 1
        while self.tokens[call].text == "::":
            call += 2
        if self.tokens[call].text in (".", "->", "(", "[", "++", "--") and "{" not in [t.text for t in self.tokens[i:end]]:
            self._drop(i, end)
        return i

    def _drop(self, start: int, end: int):
        number = self._add(self.tokens[start].line, "dropped", joined(self.tokens[start:end]), "")
        if number is None:
            return
        at, close = self.tokens[start].start, self.tokens[end].end
        self.edits.append((at, at, f"{{ if (!::fastsplat_mutants::is({number})) "))
        self.edits.append((close, close, " }"))
