"""Two small scenes of several tests: a sign that a ball tears off its chains, and two stacks of which one is hit."""

GUN = """[[actor]]
name = "tank"
type = "tank"
space = "far"
position = [-12, 0, 0]
[[actor]]
name = "ball"
type = "projectile"
space = "far"
shape = "sphere"
radius = 0.2
density = 800
position = [-12, 4, 0]
fired_by = "tank"
muzzle_speed = 20
first_shot = {0}
"""

SIGN = """title = "a sign on two chains, and a ball shot at it"
spaces = ["sign", "far"]
[[actor]]
name = "ground"
type = "ground"
[[actor]]
name = "board"
type = "box"
space = "sign"
size = [0.1, 1.6, 0.8]
mass = 30
position = [0, 0, 1.6]
variation = { position = [0.05, 0, 0] }
[[actor]]
name = "left"
type = "box"
space = "sign"
size = [0.1, 0.1, 0.4]
mass = 2
position = [0, 0.7, 2.4]
[[actor]]
name = "right"
type = "box"
space = "sign"
size = [0.1, 0.1, 0.4]
mass = 2
position = [0, -0.7, 2.4]
""" + GUN.format(0.2)
JOINT = """[[joint]]
name = "{0}"
kind = "{1}"
bodies = [{2}]
anchor = {3}
{4}
"""
SIGN += (JOINT.format("left hook", "ball", '"left", "world"', [0, 0.7, 2.6], "break_force = 800")
         + JOINT.format("right hook", "ball", '"right", "world"', [0, -0.7, 2.6], "break_force = 5000")
         + JOINT.format("left link", "hinge", '"board", "left"', [0, 0.7, 2.1], "axis = [0, 1, 0]\nbreak_force = 700")
         + JOINT.format("right link", "hinge", '"board", "right"', [0, -0.7, 2.1], "axis = [0, 1, 0]"))

STACKS = """title = "two stacks, and a ball thrown at the first"
spaces = ["low", "high", "far"]
[effects]
sleeping = true
[sleep]
after = 0.3
[[actor]]
name = "ground"
type = "ground"
""" + GUN.format(0.7)
BOX = """[[actor]]
name = "box{0}"
type = "box"
space = "{1}"
size = [0.6, 0.6, 1]
mass = 20
position = [{2}, 0, {3}]
variation = {{ position = [0.02, 0, 0] }}
"""
STACKS += "".join(BOX.format(2 * stack + i, ("low", "high")[i], 9 * stack, 0.5 + i)
                  for stack in (0, 1) for i in (0, 1))
