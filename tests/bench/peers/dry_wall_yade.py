# The dry wall of scenes/bench/dry_wall.lua in Yade with polyhedra. compare.py runs it as
#   yade -n -x -j1 dry_wall_yade.py BRICKS COURSES DT STEPS
# The normal force follows from the volume of overlap (Elias 2014), so a contact has no face stiffness kn. Friction, bricks and shaking are
# those of the scene.
import math
import sys
import time

from yade import polyhedra_utils

bricks, courses, dt, steps = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4])
length, width, height = 0.3, 0.125, 0.1
material = PolyhedraMat(density=1800, young=5e9, poisson=0.2, frictionAngle=math.atan(0.6))


def box(x, z, l, w, h, fixed=False):
    half = [(sx * l / 2, sy * w / 2, sz * h / 2) for sx in (-1, 1) for sy in (-1, 1) for sz in (-1, 1)]
    body = polyhedra_utils.polyhedra(material, v=half, fixed=fixed)
    body.state.pos = (x, 0, z)
    return O.bodies.append(body)


plate = box(bricks * length / 2, -0.05, bricks * length + 0.2, 0.325, 0.1, fixed=True)
for course in range(courses):
    z = (course + 0.5) * height
    if course % 2 == 0:
        for i in range(bricks):
            box((i + 0.5) * length, z, length, width, height)
    else:
        box(length / 4, z, length / 2, width, height)
        for i in range(1, bricks):
            box(i * length, z, length, width, height)
        box(bricks * length - length / 4, z, length / 2, width, height)


def shake():
    w, a = 2 * math.pi * 2, 0.3 * 9.81
    O.bodies[plate].state.vel = (0, a / w * (1 - math.cos(w * O.time)), 0)


O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Polyhedra_Aabb()], verletDist=0.005),
    InteractionLoop([Ig2_Polyhedra_Polyhedra_PolyhedraGeom()], [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                    [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),
    PyRunner(command='shake()', iterPeriod=1),
    NewtonIntegrator(damping=0.0, gravity=(0, 0, -9.81)),
]
O.dt = dt
O.run(2, True)  # the first search is excluded from the rate
began = time.process_time()
O.run(steps, True)
used = time.process_time() - began
print('%.6g %d %d' % (used / (steps * dt), O.interactions.countReal(), len(O.bodies) - 1))
