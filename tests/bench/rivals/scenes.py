"""Clouds of atoms, each with its view: what all programs of the comparison are given."""

import array
import dataclasses
import math
import random

# Kernels are (1 - r^2 / h^2)^N; SPACE h^3 is the integral over space.
POWER = {"wyvill": 3, "blob": 2}
SPACE = {"wyvill": 4 * math.pi * 16 / 315, "blob": 4 * math.pi * 8 / 105}


def single(x):
    """x as a float32."""
    return array.array("f", [x])[0]


def singles(v):
    return tuple(map(single, v))


@dataclasses.dataclass
class Cloud:
    """The camera looks along +z from the eye with +y up; depth is along z. All numbers are
    float32, so that all programs have the same."""
    kernel: str
    atoms: list  # of (x, y, z, strength)
    radius: float
    threshold: float
    eye: tuple
    light: tuple
    field_of_view: float  # degrees
    pixels: int = 512
    body: tuple = None  # nearest and farthest depth of the surface; else those of the supports
    cells: float = 7.2  # of Blender and voxels of OpenVDB, in a support radius

    def __post_init__(self):
        self.atoms = [singles(atom) for atom in self.atoms]
        self.radius = single(self.radius)
        self.threshold = single(self.threshold)
        self.eye = singles(self.eye)
        self.light = singles(self.light)

    def depths(self):
        """Bounds of the body's depths."""
        if self.body:
            return self.body
        near = min(atom[2] for atom in self.atoms) - self.radius - self.eye[2]
        far = max(atom[2] for atom in self.atoms) + self.radius - self.eye[2]
        margin = 0.02 * (far - near)
        return near - margin, far + margin

    def light_distance(self):
        """From the middle of the body."""
        x, y, z = self.eye
        return math.dist(self.light, (x, y, z + sum(self.depths()) / 2))

    def mapped(self, point, length=lambda x: x):
        """With points and lengths replaced."""
        return dataclasses.replace(
            self, atoms=[(*point(atom[:3]), atom[3]) for atom in self.atoms],
            radius=length(self.radius), eye=point(self.eye), light=point(self.light))

    def scaled(self, s):
        return self.mapped(lambda p: tuple(s * x for x in p), lambda x: s * x)

    def moved(self, d):
        return self.mapped(lambda p: tuple(x + d for x in p))

    def write(self, path):
        """The file that cloud.h describes."""
        words = [self.kernel, self.threshold, self.radius, self.pixels, self.field_of_view,
                 *self.eye, *self.light, *self.depths(), len(self.atoms)]
        with open(path, "wb") as file:
            file.write((" ".join(map(str, words)) + "\n").encode())
            array.array("f", (x for atom in self.atoms for x in atom)).tofile(file)


def turned(a, b, angle):
    return (math.cos(angle) * a + math.sin(angle) * b, math.cos(angle) * b - math.sin(angle) * a)


def grid(kernel, count):
    """The particles of a fluid: a cube of points one apart, jittered, supports of 1.8, threshold
    half the field deep inside. Turned, so that three faces show."""
    side = round(count ** (1 / 3))
    draw = random.Random(1)
    atoms = []
    for index in range(side ** 3):
        cell = (index % side, index // side % side, index // side ** 2)
        x, y, z = (c - (side - 1) / 2 + draw.uniform(-0.25, 0.25) for c in cell)
        x, z = turned(x, z, 0.6)
        z, y = turned(z, y, -0.5)
        atoms.append((x, y, z, 1))
    far = 2.5 * (side + 1)
    return Cloud(kernel, atoms, 1.8, SPACE[kernel] * 1.8 ** 3 / 2, eye=(0, 0, -far),
                 light=(-0.6 * far, 0.8 * far, -far), field_of_view=40)


def stiff(kernel):
    """Strengths 1e4 beside 1e-4: the skin is almost flat where strong atoms end, and steep about
    weak ones."""
    draw = random.Random(2)
    atoms = [(*(draw.uniform(-3, 3) for _ in range(3)), 1e-4 if i % 2 else 1e4)
             for i in range(400)]
    return Cloud(kernel, atoms, 1, 5e-5, eye=(0, 0, -12), light=(-8, 10, -12), field_of_view=40)


def pile(kernel, count):
    """All atoms in one place: a ball."""
    return Cloud(kernel, [(0, 0, 0, 1)] * count, 1, count / 2, eye=(0, 0, -3), light=(-2, 3, -3),
                 field_of_view=30)


def neck(kernel):
    """Two atoms whose bridge is within 1e-9 of breaking, looked at from so near that its width is
    about a tenth of the picture. In the plane between the atoms, at x from both, F = 2 (1 - q)^N
    with q = x^2 + r^2 reaches T at the distance r from the axis where, to first order,
    r^2 = (1 - x^2) excess / N."""
    power = POWER[kernel]
    draw = random.Random(3)
    excess = 0
    while not 5e-10 < excess < 1e-9:
        x = single(draw.uniform(0.4, 0.5))
        a = 1 - x * x
        threshold = single(2 * a ** power)
        excess = 2 * a ** power / threshold - 1
    width = math.sqrt(a * excess / power)
    view = math.degrees(2 * math.atan(10 * width / 3))
    return Cloud(kernel, [(-x, 0, 0, 1), (x, 0, 0, 1)], 1, threshold, eye=(0, 0, -3),
                 light=(-0.5, 2, -3), field_of_view=view, body=(2.9, 3.1), cells=32)


def sheet(kernel):
    """3,200 atoms in a plane, seen at a quarter to half a degree and lit at one. As the atoms are
    dense, F at a height y is nearly pi h^2 / (N + 1) (1 - y^2 / h^2)^(N + 1); the threshold is half
    of that at y = 0."""
    atoms = [(i - 31.5, 0, j - 24.5, 1) for i in range(64) for j in range(50)]
    radius, power = 1.8, POWER[kernel] + 1
    top = radius * math.sqrt(1 - 0.5 ** (1 / power))
    return Cloud(kernel, atoms, radius, math.pi * radius ** 2 / power / 2, eye=(0, top + 0.3, -60),
                 light=(-30, top + 1.2, -60), field_of_view=2)


def limb(kernel):
    """The edge of a ball, zoomed to 0.02 degrees; two atoms in one place, 2 (1 - q)^N = T."""
    ball = math.sqrt(1 - 0.25 ** (1 / POWER[kernel]))
    return Cloud(kernel, [(ball, 0, 0, 1)] * 2, 1, 0.5, eye=(0, 0, -5), light=(-1, 3, -5),
                 field_of_view=0.02, cells=32)


def breaks(kernel):
    """Where programs break, by name; the first is an ordinary one for comparison."""
    home = grid(kernel, 1000)
    return {
        "home": home,
        "scaled by 1e-2": home.scaled(1e-2),
        "scaled by 1e-3": home.scaled(1e-3),
        "scaled by 1e-6": home.scaled(1e-6),
        "scaled by 1e7": home.scaled(1e7),
        "moved by 1e6": home.moved(1e6),
        "strengths 1e4, 1e-4": stiff(kernel),
        "1,000 in one place": pile(kernel, 1000),
        "neck of 1e-9": neck(kernel),
        "grazing sheet": sheet(kernel),
        "limb at 0.02 degrees": limb(kernel),
    }
