"""The programs that are compared: each writes its input, says its commands, and reads its report.

A system has a name, the kernels that it knows, files of depths and of shaded pixels, and
- prepare(cloud): writes what it reads;
- command(kind): the words that make the picture "shade" (which is timed) or "depth";
- seconds(report): what it says of the time to read, build and trace, where it does.
"""

import array
import math
import pathlib
import re

HERE = pathlib.Path(__file__).parent


def words(v):
    return " ".join(map(repr, v))


class System:
    def __init__(self, build, folder):
        """`build`: where our programs are; `folder`: where files go, the cloud among them."""
        self.build, self.folder = build, folder


class Ours(System):
    name = "pbrt"
    kernels = ("blob", "wyvill")
    depth, shade = "pbrt-depth.exr", "pbrt.exr"

    def prepare(self, cloud):
        with open(self.folder / "atoms.xyz", "wb") as file:
            array.array("f", (x for atom in cloud.atoms for x in atom[:3])).tofile(file)
        strengths = [atom[3] for atom in cloud.atoms]
        if len(set(strengths)) == 1:
            del strengths[1:]
        x, y, z = cloud.eye
        ahead = (x, y, z + cloud.depths()[1])
        # What faces the light at the middle of the body reflects 0.5.
        intensity = math.pi * cloud.light_distance() ** 2
        (self.folder / "pbrt.pbrt").write_text(f"""LookAt {words(cloud.eye)} {words(ahead)} 0 1 0
Camera "perspective" "float fov" [{cloud.field_of_view}]
Film "image" "integer xresolution" [{cloud.pixels}] "integer yresolution" [{cloud.pixels}]
Sampler "stratified" "integer xsamples" [1] "integer ysamples" [1] "bool jitter" ["false"]
PixelFilter "box"
Integrator "whitted"
WorldBegin
LightSource "point" "point from" [{words(cloud.light)}] "rgb I" [{words([intensity] * 3)}]
Material "matte" "rgb Kd" [0.5 0.5 0.5]
Shape "metaballs" "string kernel" ["{cloud.kernel}"] "float threshold" [{cloud.threshold!r}]
  "float radius" [{cloud.radius!r}] "float strength" [{words(strengths)}]
  "string filename" ["atoms.xyz"]
WorldEnd
""")

    def command(self, kind):
        scene = self.folder / "pbrt.pbrt"
        if kind == "depth":
            return [self.build / "bench/rival-judge", "depth", scene, self.folder / self.depth]
        return [self.build / "bin/pbrt", scene, "--nthreads", "1", "--stats", "--outfile",
                self.folder / self.shade]

    def seconds(self, report):
        return times(report, r"parse ([\d.]+), build ([\d.]+), render ([\d.]+)")


class Povray(System):
    """Its blob's density is strength (1 - r^2 / R^2)^2, our kernel blob, and its threshold ours."""
    name = "POV-Ray"
    kernels = ("blob",)
    depth, shade = "povray-depth.ppm", "povray.ppm"

    def prepare(self, cloud):
        self.pixels = cloud.pixels
        atoms = "\n".join(f"sphere {{ <{x!r},{y!r},{z!r}>, {cloud.radius!r}, {s!r} }}"
                          for x, y, z, s in cloud.atoms)
        (self.folder / "atoms.inc").write_text(f"blob {{ threshold {cloud.threshold!r}\n{atoms}\n")
        eye, light = (", ".join(map(repr, v)) for v in (cloud.eye, cloud.light))
        view = f"""#version 3.7;
global_settings {{ assumed_gamma 1 max_trace_level 1 }}
background {{ rgb 0 }}
camera {{ location <{eye}> direction z right x up y angle {cloud.field_of_view} }}
"""
        (self.folder / "povray-shade.pov").write_text(view + f"""
light_source {{ <{light}> rgb 1 }}
#include "atoms.inc"
pigment {{ rgb 0.5 }} finish {{ ambient 0 diffuse 1 }} }}
""")
        # Red is the depth between near and far, green that within one of 64 slices; a function's
        # value is taken modulo 1.
        near, far = cloud.depths()
        place = f"(z - {cloud.eye[2] + near!r}) / {far - near!r}"
        (self.folder / "povray-depth.pov").write_text(view + f"""
#include "atoms.inc"
pigment {{ average pigment_map {{
  [1 function {{ {place} }} color_map {{ [0 rgb 0] [1 rgb <2, 0, 0>] }}]
  [1 function {{ 64 * {place} }} color_map {{ [0 rgb 0] [1 rgb <0, 2, 0>] }}] }} }}
finish {{ ambient 0 diffuse 0 emission 1 }} }}
""")

    def command(self, kind):
        return ["povray", f"+I{self.folder / f'povray-{kind}.pov'}",
                f"+O{self.folder / getattr(self, kind)}", f"+L{self.folder}", f"+W{self.pixels}",
                f"+H{self.pixels}", "+FP16", "File_Gamma=1.0", "-D", "-A", "+WT1", "-GR", "-GD"]

    def seconds(self, report):
        found = dict(re.findall(r"(\w+) Time: .*\n.*with ([\d.]+) CPU-seconds", report))
        if "Trace" not in found:
            return None
        return tuple(float(found.get(part, 0)) for part in ("Parse", "Bounding", "Trace"))


class Blender(System):
    """See blender_scene.py. Builds polygons as fine as the cloud says, then traces with Cycles."""
    name = "Blender"
    kernels = ("wyvill",)
    depth, shade = "blender-depth.exr", "blender.exr"

    def prepare(self, cloud):
        self.cells = cloud.cells

    def command(self, kind):
        return ["blender", "-b", "-t", "1", "--factory-startup", "--python-exit-code", "1", "-P",
                HERE / "blender_scene.py", "--", self.folder / "cloud", kind,
                self.folder / getattr(self, kind), str(self.cells)]

    def seconds(self, report):
        return times(report, r"seconds read ([\d.]+) build ([\d.]+) trace ([\d.]+)")


class OpenVdb(System):
    """See openvdb.cpp. One picture holds both, and is made once."""
    name = "OpenVDB"
    kernels = ("wyvill",)
    depth = shade = "openvdb.exr"

    prepare = Blender.prepare

    def command(self, kind):
        return [self.build / "bench/rival-openvdb", self.folder / "cloud", str(self.cells),
                self.folder / self.shade]

    seconds = Blender.seconds


RIVALS = (Povray, Blender, OpenVdb)


def times(report, pattern):
    """The three numbers that the pattern finds, or None."""
    found = re.search(pattern, report)
    return found and tuple(map(float, found.groups()))
