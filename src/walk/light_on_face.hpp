// The light of one emitter on the face of a tile, as a mean over pairs of points: a point of the face, a point of the
// emitter.
//
// sample() returns what one pair contributes without shadows, and the shadow rays that decide about it. Points of area
// lights are combined with flights by Lambert's law where the light is near (see area_light_sampling.hpp for the
// weights): random points of it would rarely fall on the part that contributes most.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "chance/paired_strata.hpp"
#include "walk/face_integral.hpp"
#include "walk/light_source.hpp"

namespace lichtmc {

// A part of the irradiance that arrives if nothing lies between two points.
struct Connection {
  double irradiance = 0.0;  // W/m² or lx
  FacePoint from;
  glm::dvec3 target{0.0};  // m
};

// Face and emitter must outlive it.
class LightOnFace {
 public:
  virtual ~LightOnFace() = default;

  // The dimensions of a sample's point that matter, the first that are divided into strata first.
  virtual std::span<const std::uint8_t> dimensions() const = 0;
  // Adds what the sample at this point contributes; the mean over the unit cube is the mean irradiance of the face.
  virtual void sample(const UnitPoint& at, std::vector<Connection>& found) = 0;

  // The mean irradiance without shadows, if it is known, and a bound of its error.
  virtual std::optional<double> unshadowed() const { return std::nullopt; }
  virtual double error_of_unshadowed() const { return 0.0; }
  // Integrates it, if that is possible; returns whether it is known then.
  virtual bool integrate(const IntegralAccuracy& /*accuracy*/) { return false; }
  // What that costs at least, in samples.
  virtual double integration_cost() const { return 0.0; }
};

// A point emitter: the points are distributed like its light.
class PointOnFace final : public LightOnFace {
 public:
  PointOnFace(const FaceTriangles& face, const PointLight& source, const IntegralAccuracy& accuracy)
      : face_(face), source_(source), integral_(FaceIntegral::by_point(face, source, accuracy)) {}

  bool is_dark() const { return integral_.empty(); }
  std::span<const std::uint8_t> dimensions() const override;
  void sample(const UnitPoint& at, std::vector<Connection>& found) override;
  std::optional<double> unshadowed() const override { return integral_.mean(); }
  double error_of_unshadowed() const override { return integral_.error(); }

 private:
  const FaceTriangles& face_;
  const PointLight& source_;
  ReferencePoint here_;
  FaceIntegral integral_;
};

// A point emitter with an opening: points uniform over both.
class OpeningOnFace final : public LightOnFace {
 public:
  OpeningOnFace(const FaceTriangles& face, const PointLight& source) : face_(face), source_(source) {}

  // Whether all of the opening is below the horizon of all parts of the face.
  bool is_dark() const;
  std::span<const std::uint8_t> dimensions() const override;
  void sample(const UnitPoint& at, std::vector<Connection>& found) override;

 private:
  const FaceTriangles& face_;
  const PointLight& source_;
  ReferencePoint here_;
};

// An area light: points uniform over the face.
class AreaOnFace final : public LightOnFace {
 public:
  AreaOnFace(const FaceTriangles& face, const AreaLight& source);

  // Whether no part of the light is above the horizon of any part of the face.
  bool is_dark() const { return dark_; }
  // Whether the light must be sampled by flights too.
  bool is_near() const { return near_; }
  // Whether its triangles are too many to find by calculation which of them a flight hits: then is_near() lights cannot
  // be sampled here.
  bool has_many_triangles() const;
  std::span<const std::uint8_t> dimensions() const override;
  void sample(const UnitPoint& at, std::vector<Connection>& found) override;
  std::optional<double> unshadowed() const override {
    return integral_ ? std::optional(integral_->mean()) : std::nullopt;
  }
  double error_of_unshadowed() const override { return integral_ ? integral_->error() : 0.0; }
  bool integrate(const IntegralAccuracy& accuracy) override;
  double integration_cost() const override;

 private:
  void add_flight(const FacePoint& from, const UnitPoint& at, std::vector<Connection>& found);

  const FaceTriangles& face_;
  const AreaLight& source_;
  ReferencePoint here_;
  bool dark_ = true;
  bool near_ = false;
  std::optional<FaceIntegral> integral_;
  std::vector<LightSample> hits_;
};

}  // namespace lichtmc
