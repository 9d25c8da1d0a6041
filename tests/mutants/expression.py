# SPDX-License-Identifier: Apache-2.0
"""Expressions as trees over tokens, by precedence climbing: what an operator's operands are, and where they end."""
from tokens import Token, closing, joined

LEVELS = [["||"], ["&&"], ["|"], ["^", "~^"], ["&"], ["==", "!=", "===", "!=="], ["<", "<=", ">", ">="],
          ["<<", ">>", "<<<", ">>>"], ["+", "-"], ["*", "/", "%"]]
_UNARY = {"!", "~", "-", "+", "&", "|", "^", "~&", "~|"}


class Unreadable(ValueError):
    """Nothing that this grammar knows: the caller leaves the expression as it is."""


class Node:
    """binary, unary, ternary, number, name, call, index, cast, group, concat, macro, text; tokens[start:end]."""

    def __init__(self, parser, kind, start, end, children=(), op=None):
        self.parser, self.kind, self.start, self.end = parser, kind, start, end
        self.children, self.op = list(children), op

    @property
    def tokens(self) -> list[Token]:
        return self.parser.tokens[self.start:self.end]

    @property
    def text(self) -> str:
        return joined(self.tokens)

    @property
    def line(self) -> int:
        return self.parser.tokens[self.op if self.op is not None else self.start].line

    def with_children(self, texts: dict) -> str:
        """Its text with some of its children's replaced: {child: text}."""
        out, at = "", self.start
        everything = self.parser.tokens
        for child in self.children:
            if child not in texts:
                continue
            out += joined(everything[at:child.start]) + " " + texts[child] + " "
            at = child.end
        return out + joined(everything[at:self.end])


class Parser:
    """SystemVerilog's expressions. C++'s differ in what a primary is: see cplusplus.py."""

    def __init__(self, tokens: list[Token], at: int, end: int):
        self.tokens, self.at, self.end = tokens, at, end

    def peek(self, ahead=0) -> str:
        return self.tokens[self.at + ahead].text if self.at + ahead < self.end else ""

    def take(self, text: str):
        if self.peek() != text:
            raise Unreadable(f"{text} expected, {self.peek()!r} found")
        self.at += 1

    def node(self, kind, start, children=(), op=None) -> Node:
        return Node(self, kind, start, self.at, children, op)

    def is_binary(self, operators) -> bool:
        return self.at < self.end and self.tokens[self.at].kind == "operator" and self.peek() in operators

    def ternary(self) -> Node:
        start = self.at
        condition = self.binary(0)
        if self.peek() != "?":
            return condition
        op = self.at
        self.at += 1
        then = self.ternary()
        self.take(":")
        otherwise = self.ternary()
        return self.node("ternary", start, [condition, then, otherwise], op)

    def binary(self, level: int) -> Node:
        if level == len(LEVELS):
            return self.unary()
        start = self.at
        left = self.binary(level + 1)
        while self.is_binary(LEVELS[level]):
            op = self.at
            self.at += 1
            left = self.node_of_binary(start, left, self.binary(level + 1), op)
        return left

    def node_of_binary(self, start, left, right, op) -> Node:
        return self.node("binary", start, [left, right], op)

    def unary(self) -> Node:
        start = self.at
        if self.peek() in _UNARY and self.tokens[self.at].kind == "operator":
            self.at += 1
            return self.node("unary", start, [self.unary()], start)
        return self.primary()

    def arguments(self, close: str) -> list[Node]:
        out = []
        while self.peek() != close:
            out.append(self.ternary())
            if self.peek() != ",":
                break
            self.at += 1
        self.take(close)
        return out

    def primary(self) -> Node:
        start = self.at
        if start >= self.end:
            raise Unreadable("nothing left")
        token = self.tokens[start]
        if token.kind == "macro":
            self.at += 1
            if self.peek() == "(":
                self.at = closing(self.tokens, self.at) + 1
            return self.node("macro", start)
        if token.kind == "number":
            self.at += 1
            return self.postfix(self.node("number", start))
        if token.kind == "name":
            self.at += 1
            while self.peek() == "::":
                self.at += 2
            node = self.node("name", start)
            if self.peek() == "(":
                self.at += 1
                node = Node(self, "call", start, self.at, self.arguments(")"))
                node.end = self.at
            return self.postfix(node)
        if token.text == "(":
            self.at += 1
            inner = self.ternary()
            self.take(")")
            return self.postfix(self.node("group", start, [inner]))
        if token.text == "{":
            return self.concat()
        raise Unreadable(f"no primary: {token.text!r}")

    def concat(self) -> Node:
        start = self.at
        self.take("{")
        first = self.ternary()
        if self.peek() == "{":  # so many times
            self.at += 1
            parts = self.arguments("}")
            self.take("}")
            return self.postfix(self.node("repeat", start, parts))
        parts = [first]
        while self.peek() == ",":
            self.at += 1
            parts.append(self.ternary())
        self.take("}")
        return self.postfix(self.node("concat", start, parts))

    def postfix(self, node: Node) -> Node:
        start = node.start
        while True:
            if self.peek() == "'" and self.peek(1) == "(":
                self.at += 2
                inner = self.ternary()
                self.take(")")
                node = self.node("cast", start, [inner])
            elif self.peek() == "[":
                self.at += 1
                first = self.ternary()
                op = self.at
                if self.peek() in (":", "+:", "-:"):
                    self.at += 1
                    self.ternary()  # a constant, as the language has it
                    self.take("]")
                    node = self.node("slice", start, [first] if self.tokens[op].text != ":" else [], op)
                    node.base = first
                else:
                    self.take("]")
                    node = self.node("index", start, [first])
            elif self.peek() == ".":
                self.at += 2
                node = self.node("name", start)
            else:
                return node
