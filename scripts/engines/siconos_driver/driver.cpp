// Steps of Siconos with an integrator that Siconos's Python does not have, on a linear system with linear unilateral constraints:
//
//     M q'' + K q = F ,   g = C q + b >= 0 ,   Newton's e for each row
//
// Reads runs on standard input: dof, constraints, theta, h, steps; then M (its diagonal), K (row by row), F, C (row by row), b, e, q, v.
// Writes q, v and the multipliers on one line after the initialisation and after every step, and an empty line after a run.
#include <SchatzmanPaoliOSI.hpp>
#include <SiconosKernel.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <memory>
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

void run(std::istream& in, std::ostream& out, size_t dof) {
  size_t constraints, steps;
  double theta, step;
  in >> constraints >> theta >> step >> steps;
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

int main(int, char** arguments) {
  // Siconos reports on standard output, so that the answer goes to a file
  std::ofstream out(arguments[1]);
  out.precision(std::numeric_limits<double>::max_digits10);
  try {
    for (size_t dof; std::cin >> dof;) run(std::cin, out, dof);
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << '\n';
    return 1;
  } catch (...) {
    Siconos::exception::process();
    return 1;
  }
  return out.flush() ? 0 : 1;
}
