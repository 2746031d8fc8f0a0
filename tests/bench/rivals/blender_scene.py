"""Runs inside Blender: blender -b -t 1 -P blender_scene.py -- CLOUD PASS PICTURE CELLS.

The kernel of Blender's metaballs is s (1 - r^2 / R^2)^3 with R the element's radius, and the
surface is where the sum is the threshold: wyvill, number for number. Only the stiffness s, at most
10, and the threshold, at most 5, need a common factor. Blender is right-handed: z is mirrored, and
the camera, not turned, looks along -z.
"""

import array
import math
import sys
import time

import bpy

path, kind, picture, cells = sys.argv[sys.argv.index("--") + 1:]
with open(path, "rb") as file:
    words = file.readline().split()
    atoms = array.array("f", file.read())
(threshold, radius, pixels, field_of_view, ex, ey, ez, lx, ly, lz, near, far, count) = map(
    float, words[1:])
strongest = max(atoms[3::4])
unit = min(1, 5 / threshold, 10 / strongest)

begun = time.process_time()
scene = bpy.context.scene
for old in list(bpy.data.objects):
    bpy.data.objects.remove(old)
ball = bpy.data.metaballs.new("atoms")
ball.threshold = unit * threshold
ball.resolution = ball.render_resolution = radius / float(cells)
for i in range(0, len(atoms), 4):
    element = ball.elements.new()
    element.co = (atoms[i], atoms[i + 1], -atoms[i + 2])
    element.radius = radius
    element.stiffness = unit * atoms[i + 3]
body = bpy.data.objects.new("body", ball)
scene.collection.objects.link(body)

# What is drawn: the depth as light that the body gives off, or a grey matte.
material = bpy.data.materials.new("material")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
nodes.clear()
out = nodes.new("ShaderNodeOutputMaterial")
if kind == "depth":
    surface = nodes.new("ShaderNodeEmission")
    links.new(nodes.new("ShaderNodeCameraData").outputs["View Z Depth"], surface.inputs["Color"])
else:
    surface = nodes.new("ShaderNodeBsdfDiffuse")
    surface.inputs["Color"].default_value = (0.5, 0.5, 0.5, 1)
links.new(surface.outputs[0], out.inputs["Surface"])
ball.materials.append(material)

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = (ex, ey, -ez)
camera.data.angle = math.radians(field_of_view)
camera.data.clip_start = near / 2
camera.data.clip_end = far * 2
scene.collection.objects.link(camera)
scene.camera = camera
light = bpy.data.objects.new("light", bpy.data.lights.new("light", "POINT"))
light.location = (lx, ly, -lz)
light.data.shadow_soft_size = 0
distance2 = (lx - ex) ** 2 + (ly - ey) ** 2 + ((near + far) / 2 + ez - lz) ** 2
light.data.energy = 4 * math.pi ** 2 * distance2
scene.collection.objects.link(light)
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0

scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.samples = 1
cycles.use_adaptive_sampling = False
cycles.use_denoising = False
cycles.max_bounces = 0
cycles.pixel_filter_type = "GAUSSIAN"
cycles.filter_width = 0.01
scene.render.resolution_x = scene.render.resolution_y = int(pixels)
scene.render.resolution_percentage = 100
scene.render.film_transparent = False
scene.view_settings.view_transform = "Raw"
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.image_settings.color_mode = "RGB"
scene.render.filepath = picture
read = time.process_time()

# The metaballs become polygons here; then only those are left.
bpy.context.view_layer.update()
mesh = bpy.data.meshes.new_from_object(
    body.evaluated_get(bpy.context.evaluated_depsgraph_get()))
bpy.data.objects.remove(body)
scene.collection.objects.link(bpy.data.objects.new("mesh", mesh))
built = time.process_time()
bpy.ops.render.render(write_still=True)
print(f"seconds read {read - begun:.3f} build {built - read:.3f}"
      f" trace {time.process_time() - built:.3f}")
print("faces", len(mesh.polygons))
