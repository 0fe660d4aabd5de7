"""A scene file with as many bodies as one wants."""


def many_bodies(count):
    """The text of a scene: `count` boxes on the ground in rows of 100, each an actor of its own."""
    lines = ['title = "many boxes"', "[[actor]]", 'name = "ground"', 'type = "ground"']
    for i in range(count):
        lines += ["[[actor]]", f'name = "box{i}"', 'type = "box"', "size = [0.5, 0.5, 0.5]", "mass = 1",
                  f"position = [{i % 100}, {i // 100}, 0.25]"]
    return "\n".join(lines) + "\n"
