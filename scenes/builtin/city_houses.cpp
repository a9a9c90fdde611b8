#include <algorithm>
#include <cmath>

#include "scenes/builtin/city.h"

namespace umbrameter::builtin {
namespace {

// Measures of one storey's windows.
struct Storeys {
  double base = 0.15;   ///< height of the lowest floor
  double ground = 4.2;  ///< height of the lowest storey
  double height = 3.3;
  int floors = 1;
  double pier = 0.9;       ///< width of the wall between two windows
  double parapet = 1.0;    ///< height of the wall above the last window
  double spandrel = 1.15;  ///< height of the wall below a window
  double foot() const { return base - 0.35; }
  double floor(int i) const { return base + (i == 0 ? 0.0 : ground + (i - 1) * height); }
  double top() const { return floor(floors); }
};

// What runs round a corner is a little higher on the sides, so that no two faces lie in one plane.
double lift(const Face& face) { return face.along.x == 0.0 ? 0.013 : 0.0; }

constexpr double recess = 0.34;  // of the glass behind the wall's face

struct Opening {
  double u0, u1, y0, y1;
  double middle() const { return 0.5 * (u0 + u1); }
};

void add_window(Block& b, const Face& face, const Opening& o, int detail, std::uint32_t seed) {
  Mesh& frame = b.meshes[trim];
  const auto bar = [&](double u0, double u1, double y0, double y1, double depth) {
    add_box(frame, face, {u0, y0, -recess - 0.02}, {u1, y1, -recess + depth});
  };
  if (detail >= 1) {
    add_box(frame, face, {o.u0 - 0.1, o.y0 - 0.12, -recess + 0.01}, {o.u1 + 0.1, o.y0 + 0.03, 0.1});
    bar(o.middle() - 0.035, o.middle() + 0.035, o.y0, o.y1, 0.07);
  }
  if (detail >= 2) {
    const double transom = o.y0 + 0.62 * (o.y1 - o.y0);
    bar(o.u0 - 0.05, o.u0 + 0.07, o.y0, o.y1, 0.1);
    bar(o.u1 - 0.07, o.u1 + 0.05, o.y0, o.y1, 0.1);
    bar(o.u0 + 0.03, o.u1 - 0.03, o.y1 - 0.08, o.y1 + 0.05, 0.09);
    bar(o.u0 + 0.04, o.u1 - 0.04, transom - 0.035, transom + 0.035, 0.085);
    add_box(frame, face, {o.u0 - 0.16, o.y1 + 0.02, -0.12}, {o.u1 + 0.16, o.y1 + 0.2, 0.07});
  }
  if (detail >= 3) {
    for (const double t : {0.25, 0.75}) {
      const double u = glm::mix(o.u0, o.u1, t);
      bar(u - 0.018, u + 0.018, o.y0 + 0.02, o.y1 - 0.02, 0.045);
    }
    add_box(frame, face, {o.u0 - 0.2, o.y1 + 0.19, -0.1}, {o.u1 + 0.2, o.y1 + 0.27, 0.16});
    const double draw = chance(seed, 1);
    if (draw < 0.12) {
      // An air conditioner on the sill.
      add_box(frame, face, {o.middle() - 0.33, o.y0 + 0.02, -recess}, {o.middle() + 0.33, o.y0 + 0.44, 0.28});
      for (int i = 0; i < 5; ++i) {
        const double y = o.y0 + 0.08 + 0.07 * i;
        add_box(b.meshes[iron], face, {o.middle() - 0.29, y, 0.2}, {o.middle() + 0.29, y + 0.03, 0.3});
      }
    } else if (draw < 0.3) {
      add_box(b.meshes[timber], face, {o.u0 + 0.05, o.y0 + 0.02, -0.03}, {o.u1 - 0.05, o.y0 + 0.26, 0.22});
    }
  }
}

// Louvres in a frame, folded back on the wall on both sides.
void add_shutters(Block& b, const Face& face, const Opening& o, double width) {
  Mesh& mesh = b.meshes[paint];
  for (const double start : {o.u0 - 0.06 - width, o.u1 + 0.06}) {
    add_box(mesh, face, {start, o.y0, 0.012}, {start + 0.06, o.y1, 0.07});
    add_box(mesh, face, {start + width - 0.06, o.y0, 0.012}, {start + width, o.y1, 0.07});
    const int slats = 14;
    for (int i = 0; i < slats; ++i) {
      const double y = glm::mix(o.y0 + 0.03, o.y1 - 0.1, static_cast<double>(i) / (slats - 1));
      add_box(mesh, face, {start + 0.04, y, 0.02}, {start + width - 0.04, y + 0.055, 0.055});
    }
  }
}

void add_balcony(Block& b, const Face& face, const Opening& o, int detail) {
  const double left = o.u0 - 0.45, right = o.u1 + 0.45, y = o.y0 - 0.35, reach = 0.95;
  add_box(b.meshes[trim], face, {left, y - 0.17, -0.2}, {right, y, reach});
  for (const double u : {left + 0.2, right - 0.4}) {
    add_box(b.meshes[trim], face, {u, y - 0.5, -0.15}, {u + 0.2, y - 0.16, 0.55});
  }
  Mesh& mesh = b.meshes[iron];
  add_box(mesh, face, {left + 0.02, y + 0.98, reach - 0.09}, {right - 0.02, y + 1.03, reach - 0.03});
  for (const double u : {left + 0.03, right - 0.08}) {
    add_box(mesh, face, {u, y + 0.985, -0.05}, {u + 0.05, y + 1.025, reach - 0.05});
  }
  const int bars = detail >= 3 ? 17 : 9;
  for (int i = 0; i < bars; ++i) {
    const double u = glm::mix(left + 0.035, right - 0.06, static_cast<double>(i) / (bars - 1));
    add_box(mesh, face, {u, y - 0.05, reach - 0.075}, {u + 0.025, y + 1.0, reach - 0.05});
  }
  for (int i = 1; i < bars / 3; ++i) {
    const double w = reach * i / (bars / 3.0);
    for (const double u : {left + 0.04, right - 0.07}) {
      add_box(mesh, face, {u, y - 0.05, w}, {u + 0.025, y + 1.0, w + 0.025});
    }
  }
}

// Landings, rails and stairs in front of one column of windows.
void add_fire_escape(Block& b, const Face& face, const Storeys& s, double left, double right, int detail) {
  Mesh& mesh = b.meshes[iron];
  const double reach = 1.15;
  for (int i = 1; i < s.floors; ++i) {
    const double y = s.floor(i) + 0.45;
    if (detail >= 2) {
      const int bars = detail >= 3 ? 20 : 9;
      for (int k = 0; k < bars; ++k) {
        const double u = glm::mix(left, right - 0.05, static_cast<double>(k) / (bars - 1));
        add_box(mesh, face, {u, y, -0.1}, {u + 0.05, y + 0.04, reach});
      }
      add_box(mesh, face, {left - 0.03, y - 0.09, 0.1}, {right + 0.03, y + 0.01, 0.16});
      add_box(mesh, face, {left - 0.03, y - 0.09, reach - 0.1}, {right + 0.03, y + 0.01, reach - 0.04});
    } else {
      add_box(mesh, face, {left, y, -0.1}, {right, y + 0.05, reach});
    }
    for (const double up : {0.5, 0.95}) {
      add_box(mesh, face, {left - 0.02, y + up, reach - 0.05}, {right + 0.02, y + up + 0.04, reach - 0.01});
      for (const double u : {left - 0.01, right - 0.03}) {
        add_box(mesh, face, {u, y + up, -0.1}, {u + 0.04, y + up + 0.038, reach - 0.03});
      }
    }
    const int posts = detail >= 2 ? 9 : 3;
    for (int k = 0; k < posts; ++k) {
      const double u = glm::mix(left, right - 0.035, static_cast<double>(k) / (posts - 1));
      add_box(mesh, face, {u, y - 0.02, reach - 0.045}, {u + 0.03, y + 0.97, reach - 0.015});
    }
    if (i + 1 == s.floors) break;
    // Stairs to the next landing.
    const double u0 = left + 0.35, u1 = right - 0.35;
    for (const double w : {0.42, 0.98}) {
      std::array<dvec3, 8> corners;
      for (std::size_t c = 0; c < 8; ++c) {
        const bool upper = (c & 1u) != 0;
        corners[c] = face.at(upper ? u1 : u0, (upper ? y + s.height : y) + ((c & 2u) != 0 ? 0.2 : 0.0),
                             w + ((c & 4u) != 0 ? 0.035 : 0.0));
      }
      add_solid(mesh, corners);
    }
    const int treads = detail >= 2 ? 11 : 0;
    for (int k = 0; k < treads; ++k) {
      const double t = (k + 0.7) / treads;
      const double u = glm::mix(u0, u1, t), rise = y + s.height * t;
      add_box(mesh, face, {u, rise, 0.43}, {u + 0.2, rise + 0.035, 1.0});
    }
  }
}

void add_cornice(Block& b, const Face& face, double y, int detail) {
  Mesh& mesh = b.meshes[trim];
  const double end = face.width;
  add_box(mesh, face, {-0.2, y - 0.45, -0.2}, {end + 0.2, y - 0.2, 0.2});
  add_box(mesh, face, {-0.55, y - 0.02, -0.21}, {end + 0.55, y + 0.22, 0.55});
  if (detail >= 1) {
    const int count = std::max(3, static_cast<int>(end / (detail >= 3 ? 0.42 : detail == 2 ? 0.7 : 1.6)));
    for (int i = 0; i < count; ++i) {
      const double u = end * (i + 0.5) / count;
      add_box(mesh, face, {u - 0.1, y - 0.21, -0.1}, {u + 0.1, y - 0.01, 0.46});
    }
  }
}

// Shop windows under an awning.
void add_shop(Block& b, const Face& face, const Opening& o, int detail, std::uint32_t seed) {
  add_box(b.meshes[paint], face, {o.u0 - 0.02, o.y0 - 0.2, -0.3}, {o.u1 + 0.02, o.y0 + 0.5, -0.1});
  if (detail < 1 || chance(seed, 2) < 0.3) return;
  std::array<dvec3, 8> corners;
  for (std::size_t c = 0; c < 8; ++c) {
    const bool far = (c & 4u) != 0;
    corners[c] = face.at((c & 1u) != 0 ? o.u1 + 0.1 : o.u0 - 0.1,
                         o.y1 + (far ? -0.75 : 0.05) + ((c & 2u) != 0 ? 0.06 : 0.0), far ? 1.5 : -0.05);
  }
  add_solid(b.meshes[paint], corners);
  if (detail < 2) return;
  for (const double u : {o.u0, o.u1 - 0.03}) {
    add_box(b.meshes[iron], face, {u, o.y1 - 0.8, -0.1}, {u + 0.03, o.y1 - 0.77, 1.45});
  }
}

// What does not face a street is plainer.
void add_front(Block& b, const Face& face, const Storeys& s, const House& house, int detail, bool is_street) {
  if (!is_street) detail = std::max(0, detail - 1);
  const int bays = std::max(2, static_cast<int>(std::lround(face.width / (house.style == Style::tower ? 2.5 : 2.9))));
  const double corner = 0.55;
  const double pitch = (face.width - 2.0 * corner + s.pier) / bays;
  for (int i = 1; i < bays; ++i) {
    const double u = corner + i * pitch - s.pier;
    add_box(b.meshes[wall], face, {u, s.foot(), -recess - 0.1}, {u + s.pier, s.top() - 0.1, 0.0});
  }
  // Bands of wall from the top of one row of windows to the bottom of the next.
  const double lintel = 0.45;
  const double proud = house.style == Style::tower ? -0.12 : -0.03;
  for (int i = 0; i <= s.floors; ++i) {
    const double low = i == 0 ? s.foot() : s.floor(i) - lintel;
    const double high = i == 0 ? s.base + 0.35 : i == s.floors ? s.top() + s.parapet : s.floor(i) + s.spandrel - 0.35;
    add_box(b.meshes[wall], face, {0.1, low, -recess - 0.08}, {face.width - 0.1, high, i == s.floors ? 0.02 : proud});
  }
  const bool is_palace = house.style == Style::palace;
  if (detail >= 1 && house.style != Style::tower) {
    for (const int i : {1, s.floors - 1}) {
      if (i < 1 || (i > 1 && !is_palace)) continue;
      const double y = s.floor(i) + (i == 1 ? -0.12 : 0.1) + lift(face);
      add_box(b.meshes[trim], face, {-0.06, y, -0.1}, {face.width + 0.06, y + 0.28, 0.14});
    }
  }
  const int escape = house.style == Style::tenement && is_street ? bays / 2 : -1;
  for (int i = 0; i < s.floors; ++i) {
    for (int k = 0; k < bays; ++k) {
      const double u0 = corner + k * pitch;
      const Opening o{u0, u0 + pitch - s.pier, i == 0 ? s.base + 0.35 : s.floor(i) + s.spandrel - 0.35,
                      s.floor(i + 1) - lintel};
      const std::uint32_t seed = hash(house.seed, i, k, is_street ? 1 : 2);
      if (i == 0 && is_street && house.style != Style::tower) {
        add_shop(b, face, o, detail, seed);
        continue;
      }
      // A tower has too many windows for the finest ones.
      add_window(b, face, o, house.style == Style::tower ? std::min(detail, 3) : detail, seed);
      const bool has_balcony = is_palace && is_street && i % 2 == 0 && k % 2 == 1;
      if (detail >= 2 && has_balcony) add_balcony(b, face, o, detail);
      const double side = 0.5 * (s.pier - 0.16);
      const bool in_escape = k == escape || k + 1 == escape;
      if (detail >= 4 && house.style != Style::tower && !has_balcony && !in_escape) add_shutters(b, face, o, side);
    }
  }
  if (escape > 0 && s.floors > 2) {
    const double left = corner + (escape - 1) * pitch - 0.2;
    add_fire_escape(b, face, s, left, left + 2.0 * pitch - s.pier + 0.4, detail);
  }
  if (house.style != Style::tower) add_cornice(b, face, s.top() + s.parapet + lift(face), detail);
}

// A box of storeys: the core is of glass, and the walls stand before it.
void add_body(Block& b, const Lot& lot, const Storeys& s, const House& house, int detail) {
  const double top = s.top() + s.parapet;
  add_box(b.meshes[glass], {lot.x0 + recess, s.foot() - 0.1, lot.z0 + recess},
          {lot.x1 - recess, s.top() - 0.05, lot.z1 - recess});
  add_box(b.meshes[roofing], {lot.x0 + 0.2, s.top() - 0.1, lot.z0 + 0.2}, {lot.x1 - 0.2, s.top() + 0.1, lot.z1 - 0.2});
  for (const double x : {lot.x0 - 0.04, lot.x1 - 0.55}) {
    for (const double z : {lot.z0 - 0.04, lot.z1 - 0.55}) {
      add_box(b.meshes[wall], {x, s.foot() - 0.05, z}, {x + 0.59, top + 0.03, z + 0.59});
    }
  }
  const double width = lot.x1 - lot.x0, depth = lot.z1 - lot.z0;
  const Face front{{lot.x0, 0, lot.z1}, {1, 0, 0}, {0, 0, 1}, width};
  const Face back{{lot.x1, 0, lot.z0}, {-1, 0, 0}, {0, 0, -1}, width};
  const Face left{{lot.x0, 0, lot.z0}, {0, 0, 1}, {-1, 0, 0}, depth};
  const Face right{{lot.x1, 0, lot.z1}, {0, 0, -1}, {1, 0, 0}, depth};
  add_front(b, front, s, house, detail, !lot.faces_back);
  add_front(b, back, s, house, detail, lot.faces_back);
  for (const auto& [face, is_open] : {std::pair{left, lot.open_left}, {right, lot.open_right}}) {
    if (is_open) {
      add_front(b, face, s, house, detail, house.style != Style::tenement);
    } else {
      add_box(b.meshes[wall], face, {0.2, s.foot(), -recess - 0.1}, {depth - 0.2, top, 0.0});
    }
  }
}

}  // namespace

Block build(const House& house, int detail) {
  Block block;
  Storeys s;
  s.floors = house.floors;
  if (house.style == Style::tenement) {
    s.height = 3.1 + chance(house.seed, 10, 0.0, 0.25), s.pier = 1.35, s.ground = 3.9;
    add_body(block, house.lot, s, house, detail);
    add_roof_things(block, house.lot, s.top() + 0.1, house.seed, detail);
  } else if (house.style == Style::palace) {
    s.height = 3.6 + chance(house.seed, 10, 0.0, 0.3), s.pier = 1.2, s.ground = 5.0, s.parapet = 1.3;
    add_body(block, house.lot, s, house, detail);
    add_roof_things(block, house.lot, s.top() + 0.1, house.seed, detail);
  } else {
    // Three bodies inside of one another, the inner ones higher.
    s.height = 3.4, s.pier = 0.75, s.ground = 5.5, s.spandrel = 1.0;
    Lot lot = house.lot;
    lot.open_left = lot.open_right = true;
    int built = 0;
    for (const double share : {0.5, 0.8, 1.0}) {
      s.floors = std::max(2, static_cast<int>(share * house.floors) - built);
      add_body(block, lot, s, house, detail);
      built += s.floors;
      s.base = s.top(), s.ground = s.height;
      s.floors = 0;
      lot.x0 += 1.9, lot.x1 -= 1.9, lot.z0 += 1.6, lot.z1 -= 1.6;
    }
    const dvec3 middle{0.5 * (lot.x0 + lot.x1), s.base + 0.1, 0.5 * (lot.z0 + lot.z1)};
    add_box(block.meshes[wall], middle - dvec3(2.6, 0.2, 2.2), middle + dvec3(2.6, 3.4, 2.2));
    add_mast(block.meshes[iron], middle + dvec3(0, 3.3, 0), 9.0 + 0.3 * house.floors, detail);
  }
  return block;
}

}  // namespace umbrameter::builtin
