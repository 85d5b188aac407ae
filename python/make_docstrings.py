"""make_docstrings.py STUB: prints the docstrings of a stub as entries of C++: name, signature, text.

The stub is the only place where the package is described; src/docstrings.cpp gives its texts to what runs.
"""

import ast
import inspect
import json
import pathlib
import sys


def signature(function: ast.FunctionDef) -> str:
    """Returns "name(arguments)" without types."""
    arguments = function.args
    for argument in [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, arguments.vararg, arguments.kwarg]:
        if argument:
            argument.annotation = None
    return f"{function.name}({ast.unparse(arguments)})"


def is_of_types_only(node: ast.ClassDef) -> bool:
    return any(isinstance(base, ast.Name) and base.id in ("TypedDict", "Protocol") for base in node.bases)


def entries(body: list[ast.stmt], prefix: str = "") -> dict[str, tuple[str, str]]:
    found: dict[str, tuple[str, str]] = {}
    for node in body:
        if isinstance(node, ast.FunctionDef):
            name, decorators = prefix + node.name, [ast.unparse(one) for one in node.decorator_list]
            made = "" if "property" in decorators else signature(node)
            if name in found and made not in found[name][0]:  # an overload
                made = f"{found[name][0]}\n{made}"
            elif name in found:
                made = found[name][0]
            found[name] = (made, ast.get_docstring(node) or "")
        elif isinstance(node, ast.ClassDef) and not is_of_types_only(node):
            found[node.name] = ("", ast.get_docstring(node) or "")
            for base in node.bases:  # members that it has from another class of the stub
                start = f"{ast.unparse(base)}."
                found |= {name.replace(start, f"{node.name}.", 1): one for name, one in found.items() if name.startswith(start)}
            found |= entries(node.body, f"{node.name}.")
    return found


for name, (made, text) in entries(ast.parse(pathlib.Path(sys.argv[1]).read_text()).body).items():
    print("{" + ", ".join(json.dumps(inspect.cleandoc(part), ensure_ascii=True) for part in (name, made, text)) + "},")
