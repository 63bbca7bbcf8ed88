// Lights that begin with former ones: against closed forms, and against light begun from nothing.
#include "radiosity/former_lights.h"

#include <gtest/gtest.h>

#include <cmath>

#include "form_factors/form_factor.h"
#include "radiosity/patch_rows.h"
#include "radiosity/solver_scene.h"
#include "radiosity/surface_light.h"

namespace tenku {
namespace {

using testing_support::expect_balanced;
using testing_support::SolverScene;

constexpr double kRho = 0.6;

/// A closed room whose floor is its first surface.
struct Room : SolverScene {
  Room() {
    const std::uint32_t wall = grey(kRho);
    room({4, 5, 3}, {wall, wall, wall, wall, wall, wall}, 1.0);
    surfaces = surface_light(mesh, materials, findings);
    method = form_factor_method("hemisphere-rays", mesh, {.resolution = 32});
  }
  std::vector<Rgb> light_on(std::size_t first, std::size_t end, Rgb lux) const {
    std::vector<Rgb> direct(mesh.sides());
    for (std::size_t s = 2 * first; s < 2 * end; s += 2) direct[s] = lux;
    return direct;
  }
  std::vector<Rgb> even_light() const { return light_on(0, mesh.size(), Rgb::grey(100.0)); }
  std::vector<Rgb> light_on_floor(Rgb lux) const { return light_on(0, 4 * 5 * 2, lux); }

  RefinementResult shoot(const std::vector<Rgb>& direct, SentLight start = {}) const {
    Progress quiet;
    PatchRows rows(mesh, *method, {});
    RefinementOptions options;
    options.tolerance = 1e-4;
    options.start = std::move(start);
    return refine_progressively(mesh, surfaces, direct, rows, options, quiet);
  }
  std::vector<double> source(const std::vector<Rgb>& direct) const {
    std::vector<double> sent;
    for (const Rgb lux : direct) sent.push_back(kRho * luminance_of(lux));
    return sent;
  }
  double received_lm(const RefinementResult& shots) const {
    double sum = 0.0;
    for (std::size_t s = 0; s < mesh.sides(); ++s) {
      sum += mesh.area_m2(s / 2) * luminance_of(shots.sides.received[s]);
    }
    return sum;
  }

  std::vector<Finding> findings;
  SurfaceLight surfaces;
  std::unique_ptr<FormFactorMethod> method;
};

SentLight times(double factor, const RefinementResult& shots) {
  SentLight sent;
  sent.escaped_lm = factor * shots.balance.escaped_lm;
  for (std::size_t s = 0; s < shots.sides.received.size(); ++s) {
    sent.received.push_back(factor * shots.sides.received[s]);
    sent.radiosity.push_back(factor * (shots.sides.radiosity[s] + -1.0 * shots.sides.unshot[s]));
  }
  return sent;
}

/// The furnace: evenly lit, all that is brought in comes back rho + rho^2 + ... times.
TEST(ShotsThatBeginWithTooMuch, TakeItBack) {
  const Room room;
  const RefinementResult other = room.shoot(room.light_on_floor({900.0, 300.0, 50.0}));
  const RefinementResult shots = room.shoot(room.even_light(), times(1.7, other));
  EXPECT_TRUE(shots.is_converged);
  expect_balanced(shots.balance);
  EXPECT_LE(std::abs(shots.balance.unshot_lm), 0.0005 * shots.balance.emitted_lm);
  const double area = 2.0 * (4 * 5 + 5 * 3 + 3 * 4), truth = 100.0 * area * kRho / (1.0 - kRho);
  EXPECT_NEAR(room.received_lm(shots), truth, shots.left_lm + 1e-5 * truth);
  Rgb sum;  // in each channel
  for (std::size_t s = 0; s < room.mesh.sides(); ++s) {
    sum = sum + room.mesh.area_m2(s / 2) * shots.sides.received[s];
  }
  EXPECT_NEAR(sum.r, truth, 0.001 * truth);
  EXPECT_NEAR(sum.b, truth, 0.001 * truth);
}

TEST(FormerLights, ThatMakeUpAnotherLeaveNothingToShoot) {
  const Room room;
  const std::vector<double> weight(room.mesh.sides(), 1.0);
  const auto even = room.even_light(), on_floor = room.light_on_floor(Rgb::grey(500.0));
  FormerLights former;
  for (const auto& direct : {even, on_floor}) {
    const RefinementResult shots = room.shoot(direct);
    former.keep(room.source(direct), weight, shots, shots.sides.radiosity);
  }
  std::vector<Rgb> both;
  for (std::size_t s = 0; s < even.size(); ++s) both.push_back(0.2 * even[s] + 3.0 * on_floor[s]);
  const RefinementResult fresh = room.shoot(both),
                         shots = room.shoot(both, former.start(room.source(both), weight).sent);
  EXPECT_GT(fresh.shots, 100U);
  EXPECT_EQ(shots.shots, 0U);
  expect_balanced(shots.balance);
  EXPECT_NEAR(room.received_lm(shots), room.received_lm(fresh), shots.left_lm + fresh.left_lm);
}

TEST(FormerLights, ThatAreAlikeOrManyDoNoHarm) {
  const Room room;
  const std::vector<double> weight(room.mesh.sides(), 1.0);
  FormerLights former;
  for (std::size_t k = 0; k < FormerLights::kMost + 4; ++k) {
    // Every third is twice another.
    const auto direct = room.light_on(20 * (k / 3), 20 * (k / 3) + 20 + k % 2,
                                      Rgb::grey(k % 3 == 2 ? 200.0 : 100.0));
    const RefinementResult shots = room.shoot(direct);
    former.keep(room.source(direct), weight, shots, shots.sides.radiosity);
  }
  const RefinementResult shots =
      room.shoot(room.even_light(), former.start(room.source(room.even_light()), weight).sent);
  const double truth = 100.0 * 94.0 * kRho / (1.0 - kRho);
  expect_balanced(shots.balance);
  EXPECT_NEAR(room.received_lm(shots), truth, shots.left_lm + 1e-5 * truth);
}

TEST(FormerLights, AreNotFoundInTheDark) {
  const Room room;
  const std::vector<double> weight(room.mesh.sides(), 1.0);
  FormerLights former;
  const RefinementResult shots = room.shoot(room.even_light());
  former.keep(room.source(room.even_light()), weight, shots, shots.sides.radiosity);
  const std::vector<Rgb> dark(room.mesh.sides());
  const RefinementResult none = room.shoot(dark, former.start(room.source(dark), weight).sent);
  EXPECT_EQ(room.received_lm(none), 0.0);
  EXPECT_EQ(none.shots, 0U);
}

}  // namespace
}  // namespace tenku
