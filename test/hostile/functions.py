# SPDX-License-Identifier: Apache-2.0
"""Finds the functions of the library that a renderer's types could be looked up for, and who calls them unqualified.

    functions.py INCLUDE_DIR --names      the names of all free functions
    functions.py INCLUDE_DIR --calls      every unqualified call of one: FILE:LINE: NAME
    functions.py INCLUDE_DIR --header     a header that declares all of them in namespace hostile

C++ also looks for the name of an unqualified call in the namespaces of its arguments' types. A renderer that has a function
of the same name there would be called in the library's place.
"""
import pathlib
import re
import sys

KEYWORDS = {"if", "for", "while", "switch", "return", "sizeof", "alignof", "decltype", "static_assert", "operator",
            "noexcept", "alignas", "defined", "catch", "else", "throw", "requires", "__attribute__", "__launch_bounds__",
            "vector_size", "asm", "explicit"}
TOKEN = re.compile(r"[A-Za-z_]\w*|::|->|\.\.\.|&&|[^\s\w]")


def code_of(path):
    """The text of a file without comments, strings and preprocessor lines, with its lines where they were."""
    text = path.read_text(encoding="utf-8")
    text = re.sub(r"/\*.*?\*/", lambda m: "\n" * m.group().count("\n"), text, flags=re.S)
    text = re.sub(r"//[^\n]*", "", text)
    text = re.sub(r'"(\\.|[^"\\\n])*"', '""', text)
    return re.sub(r"^[ \t]*#(\\\n|[^\n])*", lambda m: "\n" * m.group().count("\n"), text, flags=re.M)


def tokens_of(text):
    return [(m.group(), text.count("\n", 0, m.start()) + 1) for m in TOKEN.finditer(text)]


def scopes(tokens):
    """For each token, the kinds of the braces around it: "namespace", "class" or "body"."""
    kinds, result, statement = [], [], []
    for word, _ in tokens:
        if word == "}":
            if kinds:
                kinds.pop()
            statement = []
        result.append(tuple(kinds))
        if word == "{":
            if "namespace" in statement:
                kinds.append("namespace")
            elif statement and any(w in ("struct", "class", "enum", "union") for w in statement) and "(" not in statement:
                kinds.append("class")
            else:
                kinds.append("body")
            statement = []
        elif word == ";":
            statement = []
        elif word != "}":
            statement.append(word)
    return result


def is_qualified(tokens, k):
    return k > 0 and tokens[k - 1][0] in ("::", ".", "->")


def behind_template_arguments(tokens, k):
    """The index behind NAME or NAME<...>, where a call has its parenthesis."""
    k += 1
    if k < len(tokens) and tokens[k][0] == "<":
        depth = 0
        while k < len(tokens):
            word = tokens[k][0]
            depth += {"<": 1, ">": -1}.get(word, 0)
            k += 1
            if depth == 0:
                break
            if word in (";", "{"):
                return None
    return k if k < len(tokens) and tokens[k][0] == "(" else None


def declares(tokens, k):
    """Whether the name at k is declared there, and not called: a type stands before it."""
    before = tokens[k - 1][0] if k else ""
    if before == ")":
        return tokens[k - 2][0] == "auto"  # decltype(auto)
    return (re.fullmatch(r"[A-Za-z_]\w*", before) and before not in KEYWORDS) or before in (">", "*", "&", "&&")


def free_functions(files):
    names = set()
    for tokens in files.values():
        for (word, _), scope, k in zip(tokens, scopes(tokens), range(len(tokens))):
            if all(kind == "namespace" for kind in scope) and re.fullmatch(r"[A-Za-z_]\w*", word) and \
                    word not in KEYWORDS | {"const"} and k + 1 < len(tokens) and tokens[k + 1][0] == "(" and declares(tokens, k):
                names.add(word)
    # What looks like one, but constructs: a deduction guide, say.
    classes = {tokens[k + 1][0] for tokens in files.values() for k in range(len(tokens) - 1)
               if tokens[k][0] in ("struct", "class")}
    return names - classes


def members(tokens):
    """Names of functions that classes of this file declare: these are found before any other."""
    return {word for (word, _), scope, k in zip(tokens, scopes(tokens), range(len(tokens)))
            if scope and scope[-1] == "class" and k + 1 < len(tokens) and tokens[k + 1][0] == "(" and declares(tokens, k)}


def unqualified_calls(files, names):
    for path, tokens in files.items():
        own = members(tokens)
        for (word, line), scope, k in zip(tokens, scopes(tokens), range(len(tokens))):
            inside = any(kind == "body" for kind in scope)
            if word in names - own and inside and not is_qualified(tokens, k) and \
                    behind_template_arguments(tokens, k) and not declares(tokens, k):
                yield path, line, word


HOSTILE = """template <class... T>
void {name}(T&&...) {{ static_assert(sizeof...(T) > 99, "{name} is looked for in the renderer's namespace"); }}
template <auto, class... T>
void {name}(T&&...) {{ static_assert(sizeof...(T) > 99, "{name} is looked for in the renderer's namespace"); }}
template <auto, auto, class... T>
void {name}(T&&...) {{ static_assert(sizeof...(T) > 99, "{name} is looked for in the renderer's namespace"); }}
template <class, auto, class... T>
void {name}(T&&...) {{ static_assert(sizeof...(T) > 99, "{name} is looked for in the renderer's namespace"); }}"""


def main():
    root = pathlib.Path(sys.argv[1])
    files = {path: tokens_of(code_of(path)) for path in sorted(root.rglob("*.hpp"))}
    names = free_functions(files)
    if len(names) < 20:
        sys.exit(f"functions.py: found only {len(names)} functions below {root}")
    if sys.argv[2] == "--names":
        print("\n".join(sorted(names)))
    elif sys.argv[2] == "--calls":
        calls = list(unqualified_calls(files, names))
        for path, line, name in calls:
            print(f"{path}:{line}: {name}")
        sys.exit(1 if calls else 0)
    else:
        print("namespace hostile {\n" + "\n".join(HOSTILE.format(name=name) for name in sorted(names)) + "\n}")


if __name__ == "__main__":
    main()
