#include <numbers>

#include "scene/layout.hpp"

namespace saccade::scene {
namespace {

constexpr double kRoomHalfWidth = 2100, kBack = 2600, kFront = -2600, kCeiling = 2600;  // the room, mm

// Adds parts with one label at a place on the floor, turned about z.
class Furniture {
 public:
  Furniture(Scene& scene, int label, const Vector3d& place, double turn_degrees)
      : scene_(scene), label_(label), place_(place), turn_(about_z(turn_degrees)) {}

  Furniture& add(const Shape& shape, const Vector3d& position, const Finish& finish,
                 const Matrix3d& rotation = Matrix3d::Identity()) {
    scene_.parts.push_back({shape, place_ + turn_ * position, turn_ * rotation, label_, finish.albedo,
                            finish.texture, finish.gloss});
    return *this;
  }
  /// A box: x and y of its middle, z of its lower face, and the lengths of its sides.
  Furniture& block(double x, double y, double z, double width, double depth, double height,
                   const Finish& finish) {
    return add(Box{{width / 2, depth / 2, height / 2}}, {x, y, z + height / 2}, finish);
  }

 private:
  Scene& scene_;
  int label_;
  Vector3d place_;
  Matrix3d turn_;
};

void add_shell(Scene& scene, double side, Random& random) {
  const Finish wall{random.between(0.95, 1.05) * cv::Vec3d(0.72, 0.77, 0.78), Texture::speckled, 0};
  Furniture shell(scene, 0, Vector3d::Zero(), 0);
  shell.block(0, 0, -100, 2 * kRoomHalfWidth, kBack - kFront, 100,
              {{0.40, 0.54, 0.68}, Texture::planks, 0.05});
  shell.block(0, kBack + 50, 0, 2 * kRoomHalfWidth + 200, 100, kCeiling, wall);
  for (const double x : {-1.0, 1.0})
    shell.block(x * (kRoomHalfWidth + 50), 0, 0, 100, kBack - kFront, kCeiling, wall);
  shell.block(0, 0, kCeiling, 2 * kRoomHalfWidth, kBack - kFront, 100, {{0.8, 0.8, 0.8}});
  // Flat pictures: structure in the image, none in the depth.
  const Finish frame{{0.2, 0.25, 0.3}};
  for (int i = 0; i < 2; ++i) {
    const double x = side * (-900 + 760 * i), width = random.between(420, 560);
    shell.block(x, kBack - 4, 1350, width, 8, 420, frame);
    shell.block(x, kBack - 4.5, 1385, width - 70, 9, 350, {object_colour(random, i), Texture::checked, 0});
    shell.block(x, kBack - 5, 1460, 0.5 * width, 10, 170, {object_colour(random, i + 2)});
  }
  shell.block(side * -250, 700, 0, 2300, 1500, 6, {{0.50, 0.38, 0.45}, Texture::checked, 0});
}

void add_sofa(Furniture sofa, const Finish& cloth) {
  sofa.block(0, 0, 60, 1500, 760, 340, cloth)
      .block(0, 320, 400, 1500, 160, 420, cloth)
      .block(-830, 0, 60, 160, 800, 560, cloth)
      .block(830, 0, 60, 160, 800, 560, cloth);
}

void add_armchair(Furniture chair, const Finish& cloth) {
  chair.block(0, 0, 60, 560, 640, 330, cloth)
      .block(0, 270, 390, 560, 130, 420, cloth)
      .block(-340, 0, 60, 120, 660, 500, cloth)
      .block(340, 0, 60, 120, 660, 500, cloth);
}

void add_low_table(Furniture table, const Finish& wood) {
  table.block(0, 0, 380, 900, 520, 40, wood);
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) table.block(x * 400, y * 210, 0, 50, 50, 380, wood);
}

void add_shelf(Scene& scene, int& label, const Vector3d& place, Random& random) {
  const Finish wood{{0.32, 0.45, 0.58}, Texture::plain, 0.05};
  constexpr double kWidth = 900, kDepth = 300, kTall = 1750;
  Furniture shelf(scene, ++label, place, 0);
  shelf.block(-kWidth / 2, 0, 0, 30, kDepth, kTall, wood).block(kWidth / 2, 0, 0, 30, kDepth, kTall, wood);
  shelf.block(0, kDepth / 2, 0, kWidth, 15, kTall, wood);
  for (int board = 0; board < 5; ++board) {
    const double z = 80 + 410 * board;
    shelf.block(0, 0, z, kWidth, kDepth, 28, wood);
    if (board == 4) break;
    Furniture books(scene, ++label, place, 0);  // a row of books is one object
    double x = -kWidth / 2 + random.between(40, 160);
    const double end = x + random.between(220, 520);
    for (int book = 0; x < end; ++book) {
      const double width = random.between(28, 62), depth = random.between(170, 230),
                   height = random.between(200, 300);
      books.block(x + width / 2, -10, z + 28, width, depth, height, {object_colour(random, book)});
      x += width + 1;
    }
  }
}

void add_lamp(Furniture lamp) {
  const Finish metal{{0.35, 0.36, 0.38}, Texture::plain, 0.5};
  lamp.add(Frustum{150, 140, 30}, {0, 0, 0}, metal)
      .add(Frustum{16, 16, 1400}, {0, 0, 30}, metal)
      .add(Frustum{240, 150, 300}, {0, 0, 1380}, {{0.62, 0.85, 0.95}});
}

void add_plant(Furniture plant) {
  const Finish leaf{{0.25, 0.55, 0.28}, Texture::speckled, 0.1};
  plant.add(Frustum{120, 165, 280}, {0, 0, 0}, {{0.32, 0.42, 0.72}});
  plant.add(Sphere{210}, {0, 0, 500}, leaf)
      .add(Sphere{160}, {110, -60, 650}, leaf)
      .add(Sphere{150}, {-120, 30, 680}, leaf)
      .add(Sphere{120}, {10, 20, 820}, leaf);
}

void add_small_things(Scene& scene, int& label, const Vector3d& table, double side, Random& random) {
  const double top = 420;
  const auto on_table = [&](double x, double y) { return Vector3d(table + Vector3d(x, y, top)); };
  const Finish glaze{object_colour(random, 4), Texture::plain, 0.3};
  Furniture(scene, ++label, on_table(-260, 40), 0)
      .add(Bowl{130, 122}, {0, 0, 138}, glaze)
      .add(Frustum{60, 55, 20}, {0, 0, 0}, glaze);
  Furniture(scene, ++label, on_table(random.between(-40, 60), 90), 0)
      .add(Frustum{55, 90, 210}, {0, 0, 0}, {object_colour(random, label), Texture::striped, 0.3});
  Furniture(scene, ++label, on_table(280, -60), random.between(-40, 40))
      .block(0, 0, 0, 230, 170, 90, {object_colour(random, label), Texture::speckled, 0});
  Furniture(scene, ++label, {side * random.between(-1100, -900), random.between(0, 200), 0}, 0)
      .add(Sphere{150}, {0, 0, 150}, {object_colour(random, label), Texture::plain, 0.5});
}

}  // namespace

void lay_out_room(Scene& scene, Random& random) {
  const double side = random.chance(0.5) ? 1 : -1;  // a mirrored room is another room
  int label = 0;
  add_shell(scene, side, random);

  const Vector3d sofa(side * -480, 1950 + random.between(-60, 60), 0);
  const cv::Vec3d cloth = object_colour(random, random.integer(0, 9));
  add_sofa(Furniture(scene, ++label, sofa, 0), {0.8 * cloth, Texture::speckled, 0});
  for (const double x : {-1.0, 1.0}) {  // cushions
    const double place = x * random.between(420, 560), lean = x * random.between(5, 25);
    Furniture(scene, ++label, sofa + Vector3d(place, 130, 590), 0)
        .add(Box{{190, 60, 180}}, {0, 0, 0}, {object_colour(random, label), Texture::speckled, 0},
             about_y(lean) * about_x(-18));
  }

  const Vector3d table(side * -300, 800 + random.between(-80, 80), 0);
  add_low_table(Furniture(scene, ++label, table, random.between(-8, 8)),
                {{0.35, 0.5, 0.66}, Texture::plain, 0.1});
  add_small_things(scene, label, table, side, random);
  add_shelf(scene, label, {side * 1450, kBack - 180, 0}, random);
  const Vector3d chair(side * 1250, 950 + random.between(-100, 100), 0);
  const double chair_turn = side * random.between(-70, -45);
  add_armchair(Furniture(scene, ++label, chair, chair_turn),
               {object_colour(random, 7), Texture::speckled, 0});
  add_lamp(Furniture(scene, ++label, {side * 700, kBack - 350, 0}, 0));
  const Vector3d plant(side * -1700, 1900 + random.between(-100, 100), 0);
  add_plant(Furniture(scene, ++label, plant, random.between(0, 360)));

  scene.target_mm = {0, 1300, 620};
  scene.eye_mm = {side * random.between(0, 250), -1750, 1600};
  scene.light_mm = {side * -300, -200, 2450};
  scene.sway_rad = 14 * std::numbers::pi / 180;
}

}  // namespace saccade::scene
