"""What scenes/MODELS.md says of elements and attributes is what pbmpi does with them."""
import concurrent.futures
import os
import re
import subprocess
import tempfile
import unittest

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# A model with a body 'b', on a hinge 'h', and what goes into its places.
MJCF = """<mujoco>{top}<asset>{asset}</asset><worldbody>{world}<body name="b" pos="0 0 1">{joint}<geom name="g" size="1"/>{body}</body>
<body name="c" pos="0 0 9"><freejoint/><geom name="k" size="1"/></body></worldbody>{end}</mujoco>"""
HINGE = '<joint name="h"/>'
READ, NOTED, REFUSED = "read", "noted", "refused"

# Element of the table, the word that one of its cells has in code, what happens, and what of the model is given.
CASES = [
    ("compiler", "angle", READ, {"top": '<compiler angle="radian"/>'}),
    ("compiler", "eulerseq", READ, {"top": '<compiler eulerseq="zyx"/>'}),
    ("compiler", "coordinate=\"global\"", REFUSED, {"top": '<compiler coordinate="global"/>'}),
    ("option", "timestep", READ, {"top": '<option timestep="0.004"/>'}),
    ("option", "density", REFUSED, {"top": '<option density="1"/>'}),
    ("option", "viscosity", REFUSED, {"top": '<option viscosity="1"/>'}),
    ("default", "class", READ, {"top": '<default><default class="a"><geom size="2"/></default></default>'}),
    ("body", "mocap", NOTED, {"world": '<body mocap="true"><geom size="1"/></body>'}),
    ("body", "gravcomp", REFUSED, {"world": '<body gravcomp="1"><freejoint/><geom size="1"/></body>'}),
    ("body", "composite", REFUSED, {"world": '<body><composite type="rope"/></body>'}),
    ("body", "flexcomp", REFUSED, {"world": '<flexcomp name="f"/>'}),
    ("freejoint", "slide", READ, {"joint": '<joint type="slide"/>'}),
    ("freejoint", "frictionloss", READ, {"joint": '<joint frictionloss="1"/>'}),
    ("freejoint", "damping", NOTED, {"joint": '<joint damping="1"/>'}),
    ("freejoint", "springdamper", REFUSED, {"joint": '<joint springdamper="1 1"/>'}),
    ("geom", "capsule", READ, {"world": '<geom type="capsule" size="1 1"/>'}),
    ("geom", "plane", READ, {"world": '<geom type="plane" size="1 1 1"/>'}),
    ("geom", "ellipsoid", NOTED, {"world": '<body><freejoint/><geom type="ellipsoid" size="1 1 1"/></body>'}),
    ("geom", "hfield", READ, {"asset": '<hfield name="f" nrow="2" ncol="2" size="1 1 1 1"/>', "world": '<geom type="hfield" hfield="f"/>'}),
    ("geom", "sdf", REFUSED, {"world": '<geom type="sdf"/>'}),
    ("geom", "solref", NOTED, {"world": '<geom size="1" solref="0.1 1"/>'}),
    ("geom", "contype", READ, {"world": '<geom size="1" contype="2"/>'}),
    ("contact", "exclude", READ, {"end": '<contact><exclude body1="b" body2="c"/></contact>'}),
    ("contact", "pair", READ, {"end": '<contact><pair geom1="g" geom2="k"/></contact>'}),
    ("equality", "connect", READ, {"end": '<equality><connect body1="b" body2="c" anchor="0 0 0"/></equality>'}),
    ("equality", "tendon", REFUSED, {"end": '<equality><tendon tendon1="t"/></equality>'}),
    ("actuator", "position", NOTED, {"end": '<actuator><position joint="h" kp="1" kv="1"/></actuator>'}),
    ("actuator", "motor", NOTED, {"end": '<actuator><motor joint="h"/></actuator>'}),
    ("actuator", "dampratio", REFUSED, {"end": '<actuator><position joint="h" kp="1" dampratio="1"/></actuator>'}),
    ("deformable", "", REFUSED, {"end": '<deformable><flex name="f"/></deformable>'}),
    ("asset", "vertex", READ, {"asset": '<mesh name="m" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/>', "world": '<geom type="mesh" mesh="m"/>'}),
    ("visual", "sensor", READ, {"end": '<sensor><clock name="s"/></sensor>'}),
    ("visual", "camera", READ, {"world": "<camera/>"}),
]


def cells():
    """(element, its cells, as one text) of MJCF's table, with rows below an element counted for it."""
    with open(os.path.join(SOURCE, "scenes", "MODELS.md"), encoding="utf-8") as file:
        table = file.read().split("## What is read of MJCF")[1].split("What that means for models")[0]
    found, names = {}, []
    for row in re.findall(r"^\| (.*) \|$", table, re.MULTILINE):
        first, *rest = row.split("|")
        names = re.findall(r"`(\w+)`", first) or names
        for name in names:
            found[name] = found.get(name, "") + first + "".join(rest)
    return found


class ModelElements(unittest.TestCase):
    def describe(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "model.xml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            program = os.path.join(os.environ.get("PBMPI_BIN", ""), "pbmpi")
            return subprocess.run([program, "--scene", path, "--describe"], capture_output=True, text=True, check=False)

    def test_elements_are_read_noted_or_refused_as_the_table_says(self):
        empty = {"top": "", "asset": "", "world": "", "joint": HINGE, "body": "", "end": ""}
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            results = list(pool.map(lambda case: self.describe(MJCF.format(**{**empty, **case[3]})), CASES))
        told = cells()
        for (element, word, what, _), result in zip(CASES, results):
            with self.subTest(element=element, word=word):
                self.assertIn(f"`{word}`" if word else "refused", told[element])
                self.assertEqual(result.returncode, 2 if what == REFUSED else 0, result.stderr)
                notes = [line for line in result.stdout.splitlines() if "model.xml" in line and "note" in line]
                self.assertEqual(bool(notes), what == NOTED, (notes, result.stderr))
                if what == REFUSED:
                    self.assertIn("model.xml:", result.stderr)
                    self.assertIn("refused", told[element])


if __name__ == "__main__":
    unittest.main(verbosity=2)
