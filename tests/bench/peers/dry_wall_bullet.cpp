// The dry wall of scenes/bench/dry_wall.lua in Bullet: rigid boxes, impulses by sequential projection, no springs. The physics differs,
// since its joints have no stiffness; bricks, friction and shaking are the same. compare.py builds and runs it:
//   dry_wall_bullet BRICKS COURSES DT SECONDS   prints processor seconds per simulated second, and the contact points at the end
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 5) return std::fprintf(stderr, "usage: dry_wall_bullet BRICKS COURSES DT SECONDS\n"), 2;
  const int bricks = std::atoi(argv[1]), courses = std::atoi(argv[2]);
  const double dt = std::atof(argv[3]), seconds = std::atof(argv[4]), length = 0.3, width = 0.125, height = 0.1, pi = std::acos(-1.0);
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broad;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broad, &solver, &configuration);
  world.setGravity(btVector3(0, 0, btScalar(-9.81)));
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  const auto box = [&](double x, double z, double l, double w, double h, bool moves) {
    shapes.push_back(std::make_unique<btBoxShape>(btVector3(btScalar(l / 2), btScalar(w / 2), btScalar(h / 2))));
    const btScalar mass = moves ? btScalar(1800 * l * w * h) : 0;
    btVector3 inertia(0, 0, 0);
    if (moves) shapes.back()->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes.back().get(), inertia);
    info.m_friction = btScalar(std::sqrt(0.6));  // Bullet multiplies the coefficients of both bodies
    info.m_startWorldTransform.setOrigin(btVector3(btScalar(x), 0, btScalar(z)));
    bodies.push_back(std::make_unique<btRigidBody>(info));
    bodies.back()->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(bodies.back().get());
    return bodies.back().get();
  };
  btRigidBody* plate = box(bricks * length / 2, -0.05, bricks * length + 0.2, 0.325, 0.1, false);
  plate->setCollisionFlags(plate->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  for (int course = 0; course < courses; ++course) {
    const double z = (course + 0.5) * height;
    if (course % 2 == 0) {
      for (int i = 0; i < bricks; ++i) box((i + 0.5) * length, z, length, width, height, true);
      continue;
    }
    box(length / 4, z, length / 2, width, height, true);
    for (int i = 1; i < bricks; ++i) box(i * length, z, length, width, height, true);
    box(bricks * length - length / 4, z, length / 2, width, height, true);
  }
  const long steps = std::lround(seconds / dt);
  const std::clock_t began = std::clock();
  for (long k = 0; k < steps; ++k) {
    // The base moves by the second integral of 0.3 g sin(w t).
    const double w = 2 * pi * 2, t = double(k + 1) * dt, a = 0.3 * 9.81;
    btTransform at = plate->getWorldTransform();
    at.setOrigin(btVector3(at.getOrigin().x(), btScalar(a / w * t - a / (w * w) * std::sin(w * t)), at.getOrigin().z()));
    plate->setWorldTransform(at);
    plate->setInterpolationWorldTransform(at);
    world.stepSimulation(btScalar(dt), 0);
  }
  const double used = double(std::clock() - began) / CLOCKS_PER_SEC;
  int points = 0;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) points += dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
  std::printf("%.6g %d %zu\n", used / (double(steps) * dt), points, bodies.size() - 1);
  for (auto& body : bodies) world.removeRigidBody(body.get());
  return 0;
}
