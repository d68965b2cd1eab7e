// The script that loads a run in Blender, beside its glTF file.
#include "engine/base/error.h"
#include "engine/record/export/export.h"
#include "engine/record/format/json.h"

namespace erbs {

std::string blender_script(const std::string& glb, const std::string& script) {
  // A JSON string without characters beyond ASCII is a Python string.
  const std::string name = Json(glb).dump(-1, ' ', true, Json::error_handler_t::replace);
  return "# Loads the run beside this file in Blender, with sun, ground and camera; the film has 25 frames for each second of the run.\n"
         "#   blender --python " +
         script +
         "\n"
         "#   blender --background --python " +
         script +
         " -- picture.png 1.5   (a picture at 1.5 s)\n"
         "import os\nimport sys\n\nimport bpy\nimport numpy\nfrom mathutils import Vector\n\n"
         "RUN = os.path.join(os.path.dirname(os.path.abspath(__file__)), " +
         name + ")\nFPS = 25\n" +
         R"(
if "bool" not in numpy.__dict__:  # the glTF importer of Blender 3.4 uses a name that NumPy 1.24 has dropped
    numpy.bool = bool
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = FPS
bpy.ops.import_scene.gltf(filepath=RUN)
blocks = [o for o in bpy.data.objects if o.type == "MESH"]
ends = [a.frame_range[1] for a in bpy.data.actions]
scene.frame_start, scene.frame_end = 0, int(max(ends, default=0))


def corners(frame, objects):
    scene.frame_set(frame)
    return [o.matrix_world @ Vector(c) for o in objects for c in o.bound_box]


# What moves, or all blocks where nothing does: the ground would make the picture too wide.
moving = [o for o in blocks if o.animation_data] or blocks
seen = corners(scene.frame_end, moving) + corners(0, moving)
low = Vector(min(p[i] for p in seen) for i in range(3))
high = Vector(max(p[i] for p in seen) for i in range(3))
middle, size = (low + high) / 2, max((high - low).length, 0.1)

sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy, sun.data.angle = 3.5, 0.02
sun.rotation_euler = (0.75, 0.15, 0.6)
scene.collection.objects.link(sun)
scene.world = bpy.data.worlds.new("sky")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.62, 0.70, 0.80, 1)
if not [o for o in blocks if not o.animation_data]:  # without a ground of its own
    bpy.ops.mesh.primitive_plane_add(size=40 * size, location=(middle.x, middle.y, low.z))
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = middle + 1.9 * size * Vector((0.55, -0.8, 0.35)).normalized()
camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
camera.data.clip_end = 100 * size
scene.collection.objects.link(camera)
scene.camera = camera
scene.render.resolution_x, scene.render.resolution_y = 1280, 720

if "--" in sys.argv:
    wish = sys.argv[sys.argv.index("--") + 1:]
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 32, False
    scene.render.filepath = os.path.abspath(wish[0])
    scene.frame_set(int(FPS * float(wish[1])) if len(wish) > 1 else scene.frame_end)
    bpy.ops.render.render(write_still=True)
)";
}

}  // namespace erbs
