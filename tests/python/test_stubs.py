"""The stub of the extension names what it has, and everything public has a docstring."""
import ast
import inspect
import pathlib
import unittest

import pbmpi
from pbmpi import _pbmpi

STUB = pathlib.Path(_pbmpi.__file__).parent / "_pbmpi.pyi"


def members(names):
    return {name for name in names if not name.startswith("__")}


class Stubs(unittest.TestCase):
    def setUp(self):
        self.module = ast.parse(STUB.read_text(encoding="utf-8"))
        self.classes = {node.name: node for node in self.module.body if isinstance(node, ast.ClassDef)}

    def test_names_are_those_of_the_extension(self):
        stubbed = {node.name for node in self.module.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(stubbed, members(vars(_pbmpi)))
        for name, node in self.classes.items():
            described = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
            self.assertEqual(members(described), members(vars(getattr(_pbmpi, name))), name)

    def test_arguments_and_properties_are_those_of_the_extension(self):
        for name, node in self.classes.items():
            for item in node.body:
                member = vars(getattr(_pbmpi, name))[item.name]
                if isinstance(member, property):
                    self.assertEqual([ast.unparse(one) for one in item.decorator_list], ["property"], item.name)
                    continue
                arguments = [one.arg for one in item.args.args + item.args.kwonlyargs]
                first_line = member.__doc__.splitlines()[0]
                for argument in arguments:
                    self.assertIn(f"{argument}: ", first_line, item.name)
                self.assertEqual(first_line.count(": "), len(arguments), first_line)

    def test_everything_public_says_what_it_is(self):
        self.assertTrue((STUB.parent / "py.typed").is_file())
        for name in pbmpi.__all__:
            one = getattr(pbmpi, name)
            self.assertTrue(inspect.getdoc(one), name)
            for member in members(dir(one)) if inspect.isclass(one) else ():
                if not member.startswith("_"):
                    self.assertTrue(inspect.getdoc(getattr(one, member)), f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
