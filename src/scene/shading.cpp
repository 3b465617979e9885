#include "scene/shading.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scene/random.hpp"

namespace saccade::scene {
namespace {

// A ball around parts that may stand between the lamp and a surface, to reject most of them quickly.
struct Ball {
  Vector3d centre = Vector3d::Zero();
  double radius = 0;

  // Whether the line from `point` along `direction`, `square` its squared length, passes through.
  bool met_by(const Vector3d& point, const Vector3d& direction, double square) const {
    const Vector3d offset = centre - point;
    const double along = offset.dot(direction);
    return offset.squaredNorm() * square - along * along <= radius * radius * square;
  }
};

struct Blocker {
  const Part* part;
  Ball ball;
};

struct BlockerGroup {  // an object
  Ball ball;
  std::vector<Blocker> parts;
};

// The objects; the background catches shadows and casts none.
std::vector<BlockerGroup> find_blockers(const Scene& scene) {
  std::vector<BlockerGroup> groups;
  for (const Part& part : scene.parts) {
    if (part.label == 0) continue;
    const Bound own = bound(part.shape);
    groups.resize(std::max(groups.size(), static_cast<std::size_t>(part.label)));
    groups[static_cast<std::size_t>(part.label) - 1].parts.push_back(
        {&part, {part.position_mm + part.rotation * own.centre, own.radius}});
  }
  for (BlockerGroup& group : groups) {
    for (const Blocker& blocker : group.parts)
      group.ball.centre += blocker.ball.centre / static_cast<double>(group.parts.size());
    for (const Blocker& blocker : group.parts)
      group.ball.radius =
          std::max(group.ball.radius, (blocker.ball.centre - group.ball.centre).norm() + blocker.ball.radius);
  }
  return groups;
}

bool shadowed(const std::vector<BlockerGroup>& groups, const Vector3d& point, const Vector3d& to_light) {
  const double square = to_light.squaredNorm();
  for (const BlockerGroup& group : groups) {
    if (!group.ball.met_by(point, to_light, square)) continue;
    for (const Blocker& blocker : group.parts) {
      if (!blocker.ball.met_by(point, to_light, square)) continue;
      const Matrix3d to_shape = blocker.part->rotation.transpose();
      const Ray ray{to_shape * (point - blocker.part->position_mm), to_shape * to_light};
      const Hit hit = std::visit([&](const auto& body) { return intersect(body, ray); }, blocker.part->shape);
      if (hit && hit.t < 1) return true;
    }
  }
  return false;
}

// Random value in [0,1) of a cell of space.
double cell(double x, double y, double z) {
  const auto whole = [](double v) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v)) & 0x1fffff);
  };
  return uniform(mix(whole(x) << 42 | whole(y) << 21 | whole(z)));
}

double parity(double x, double y, double z) {
  const double sum = std::floor(x) + std::floor(y) + std::floor(z);
  return sum - 2 * std::floor(sum / 2);
}

// Factor on the albedo at a position in the part's own frame, mm.
double texture_at(Texture texture, const Vector3d& p) {
  switch (texture) {
    case Texture::plain:
      return 1;
    case Texture::speckled:
      return 0.88 + 0.1 * cell(p.x() / 5, p.y() / 5, p.z() / 5) +
             0.08 * cell(p.x() / 17, p.y() / 17, p.z() / 17);
    case Texture::checked:
      return 0.72 + 0.28 * parity(p.x() / 24 + 0.5, p.y() / 24 + 0.5, p.z() / 24 + 0.5);
    case Texture::striped:
      return 0.7 + 0.3 * parity(p.z() / 18 + 0.5, 0, 0);
    case Texture::planks: {
      const double plank = std::floor(p.x() / 140);
      const double along = p.y() / 900 + 0.37 * plank;
      const double grain = cell(p.x() / 6, p.y() / 160, plank);
      const double joint = p.x() / 140 - plank < 0.02 ? 0.75 : 1;
      return joint * (0.84 + 0.12 * cell(plank, along, 7) + 0.06 * grain);
    }
  }
  return 1;
}

double power16(double x) {
  for (int i = 0; i < 4; ++i) x *= x;
  return x;
}

}  // namespace

void shade(const Scene& scene, const Intrinsics& camera, const Pose& pose, SceneRender& out) {
  constexpr double kLamp = 0.72, kSky = 0.2, kCamera = 0.16;
  out.colour.create(out.depth_mm.size());
  const std::vector<BlockerGroup> blockers = find_blockers(scene);
  for (int r = 0; r < out.colour.rows; ++r)
    for (int c = 0; c < out.colour.cols; ++c) {
      if (out.parts(r, c) == 0) {
        out.colour(r, c) = {28, 24, 22};
        continue;
      }
      const Part& part = scene.parts[out.parts(r, c) - 1u];
      const cv::Point3d seen = camera.point_mm(r, c, out.depth_mm(r, c));
      const Vector3d ray = pose.rotation * Vector3d(seen.x, seen.y, seen.z);
      const cv::Vec3f& n = out.normals(r, c);
      const Vector3d normal = pose.rotation * Vector3d(n[0], n[1], n[2]);
      const Vector3d point = pose.position_mm + ray + 0.05 * normal;  // off the surface, against self-shadow
      const Vector3d to_light = scene.light_mm - point;
      const Vector3d light = to_light.normalized(), view = -ray.normalized();

      const double facing = normal.dot(light);
      double direct = 0, highlight = 0;
      if (facing > 0 && !shadowed(blockers, point, to_light)) {
        direct = kLamp * facing;
        highlight = part.gloss * power16(std::max(0.0, normal.dot((light + view).normalized())));
      }
      const double brightness = direct + kSky * (1 + 0.5 * normal.z()) + kCamera * normal.dot(view);
      const Vector3d local = part.rotation.transpose() * (point - part.position_mm);
      const double factor = brightness * texture_at(part.texture, local);
      for (int i = 0; i < 3; ++i)
        out.colour(r, c)[i] = cv::saturate_cast<uchar>(255 * (factor * part.albedo[i] + 0.5 * highlight));
    }
}

}  // namespace saccade::scene
