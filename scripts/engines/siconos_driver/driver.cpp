// Siconos with two integrators that its Python does not have. Reads runs on standard input, each with the name of its integrator:
//
//     SchatzmanPaoliOSI   M q'' + K q = F ,   g = C q + b >= 0 ,   Newton's e for each row
//       dof, constraints, theta, h, steps; then M (its diagonal), K (row by row), F, C (row by row), b, e, q, v
//       writes q, v and the multipliers after the initialisation and after every step
//
//     NewMarkAlphaOSI     m q'' + c q' + k q = -m g ,   q >= stop ,   Newton's e
//       m, k, c, g, stop, e, q, v, spectral radius, h, duration, Newton's tolerance, event tolerance
//       writes t, whether it is an impact, q, v and the impulse at the start and after every event, the first impact being the last
//
// and an empty line after a run. The answer goes to the file of the first argument: Siconos reports on standard output.
#include <LagrangianScleronomousR.hpp>
#include <NewMarkAlphaOSI.hpp>
#include <SchatzmanPaoliOSI.hpp>
#include <SiconosKernel.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

using Numbers = std::vector<double>;

Numbers read(std::istream& in, size_t count) {
  Numbers numbers(count);
  for (double& number : numbers) in >> number;
  if (!in) throw std::runtime_error("a run ends too early");
  return numbers;
}

SP::SiconosVector vector(const Numbers& numbers) {
  auto result = std::make_shared<SiconosVector>(numbers.size());
  for (size_t i = 0; i < numbers.size(); ++i) (*result)(i) = numbers[i];
  return result;
}

SP::SimpleMatrix matrix(const Numbers& numbers, size_t columns) {
  auto result = std::make_shared<SimpleMatrix>(numbers.size() / columns, columns);
  for (size_t i = 0; i < numbers.size(); ++i) (*result)(i / columns, i % columns) = numbers[i];
  return result;
}

void schatzman_paoli(std::istream& in, std::ostream& out) {
  size_t dof, constraints, steps;
  double theta, step;
  in >> dof >> constraints >> theta >> step >> steps;
  const Numbers masses = read(in, dof), stiffness = read(in, dof * dof), force = read(in, dof);
  const Numbers rows = read(in, constraints * dof), offsets = read(in, constraints), restitutions = read(in, constraints);
  const Numbers position = read(in, dof), velocity = read(in, dof);

  Numbers mass(dof * dof, 0.0);
  for (size_t i = 0; i < dof; ++i) mass[i * (dof + 1)] = masses[i];
  auto body = std::make_shared<LagrangianLinearTIDS>(vector(position), vector(velocity), matrix(mass, dof));
  if (std::any_of(stiffness.begin(), stiffness.end(), [](double k) { return k != 0.0; })) body->setKPtr(matrix(stiffness, dof));
  body->setFExtPtr(vector(force));
  auto world = std::make_shared<NonSmoothDynamicalSystem>(0.0, 1e9);
  world->insertDynamicalSystem(body);
  std::vector<SP::Interaction> contacts;
  for (size_t i = 0; i < constraints; ++i) {
    const Numbers row(rows.begin() + i * dof, rows.begin() + (i + 1) * dof);
    auto relation = std::make_shared<LagrangianLinearTIR>(matrix(row, dof), vector({offsets[i]}));
    contacts.push_back(std::make_shared<Interaction>(std::make_shared<NewtonImpactNSL>(restitutions[i]), relation));
    world->link(contacts.back(), body);
  }
  auto integrator = std::make_shared<SchatzmanPaoliOSI>(theta);
  auto instants = std::make_shared<TimeDiscretisation>(0.0, step);
  auto stepping = std::make_shared<TimeStepping>(world, instants, integrator, std::make_shared<LCP>());

  auto write = [&] {
    for (size_t i = 0; i < dof; ++i) out << (*body->q())(i) << ' ';
    for (size_t i = 0; i < dof; ++i) out << (*body->velocity())(i) << ' ';
    for (auto& contact : contacts) out << (*contact->lambda(0))(0) << ' ';
    out << '\n';
  };
  stepping->initialize();
  write();
  for (size_t k = 0; k < steps; ++k) {
    stepping->computeOneStep();
    write();
    stepping->nextStep();
  }
  out << '\n';
}

// NewMarkAlphaOSI turns the sign of a LagrangianLinearTIDS's K and C in every iteration, and takes a linear relation's gap for zero: both are nonlinear here.
struct Spring : LagrangianDS {
  const double stiffness, damping;

  Spring(double mass, double k, double c, double q, double v)
      : LagrangianDS(vector({q}), vector({v}), matrix({mass}, 1)), stiffness(k), damping(c) {
    _fInt = vector({0.0});
    _jacobianFIntq = matrix({k}, 1);
    _jacobianFIntqDot = matrix({c}, 1);
  }
  void computeFInt(double) override { computeFInt(0.0, _q[0], _q[1]); }
  void computeFInt(double, SP::SiconosVector q, SP::SiconosVector v) override { (*_fInt)(0) = stiffness * (*q)(0) + damping * (*v)(0); }
  void computeJacobianFIntq(double) override {}
  void computeJacobianFIntq(double, SP::SiconosVector, SP::SiconosVector) override {}
  void computeJacobianFIntqDot(double) override {}
  void computeJacobianFIntqDot(double, SP::SiconosVector, SP::SiconosVector) override {}
};

struct Stop : LagrangianScleronomousR {
  const double place;

  explicit Stop(double at) : place(at) {
    _jachq = matrix({1.0}, 1);
    _dotjachq = matrix({0.0}, 1);
  }
  void computeh(const BlockVector& q, BlockVector&, SiconosVector& gap) override { gap.setValue(0, q.getValue(0) - place); }
  void computeJachq(const BlockVector&, BlockVector&) override {}
  void computeDotJachq(const BlockVector&, BlockVector&, const BlockVector&) override {}
};

void newmark_alpha(std::istream& in, std::ostream& out) {
  const Numbers one = read(in, 13);
  const double mass = one[0], gravity = one[3], step = one[9], duration = one[10];
  auto body = std::make_shared<Spring>(mass, one[1], one[2], one[6], one[7]);
  body->setFExtPtr(vector({-mass * gravity}));
  auto world = std::make_shared<NonSmoothDynamicalSystem>(0.0, duration);
  world->insertDynamicalSystem(body);
  auto contact = std::make_shared<Interaction>(std::make_shared<NewtonImpactNSL>(one[5]), std::make_shared<Stop>(one[4]));
  world->link(contact, body);
  auto motion = std::make_shared<EventDriven>(world, std::make_shared<TimeDiscretisation>(0.0, step));
  motion->insertIntegrator(std::make_shared<NewMarkAlphaOSI>(one[8], false));
  for (int problem : {SICONOS_OSNSP_ED_IMPACT, SICONOS_OSNSP_ED_SMOOTH_ACC, SICONOS_OSNSP_ED_SMOOTH_POS})
    motion->insertNonSmoothProblem(std::make_shared<LCP>(), problem);
  motion->setNewtonTolerance(one[11]);
  motion->setToleranceED(one[12]);
  motion->initialize();

  const int non_smooth = 2;
  bool impact = false;
  auto write = [&] {
    out << motion->startingTime() << ' ' << impact << ' ' << (*body->q())(0) << ' ' << (*body->velocity())(0) << ' '
        << (impact ? (*contact->lambda(1))(0) : 0.0) << '\n';
  };
  write();
  while (motion->hasNextEvent() && !impact) {
    motion->advanceToEvent();
    motion->processEvents();
    impact = motion->eventsManager()->currentEvent()->getType() == non_smooth;
    write();
  }
  out << '\n';
}

int main(int, char** arguments) {
  std::ofstream out(arguments[1]);
  out.precision(std::numeric_limits<double>::max_digits10);
  try {
    for (std::string integrator; std::cin >> integrator;)
      (integrator == "NewMarkAlphaOSI" ? newmark_alpha : schatzman_paoli)(std::cin, out);
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << '\n';
    return 1;
  } catch (...) {
    Siconos::exception::process();
    return 1;
  }
  return out.flush() ? 0 : 1;
}
