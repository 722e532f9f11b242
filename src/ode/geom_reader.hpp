#pragma once

// What is read of a geom: from where libode keeps it, where that is known, else by asking. Changes
// nothing of the geom, but that bounds which have to be asked for are computed.

#include "ode/geom_layout.hpp"

namespace harpoon::ode {

/// Which of the user classes ask (`dGeomClass::aabb_test`); null where one does not.
using UserTests = AabbTest * [geom_class::kUserClasses];

template <class Real>
struct GeomReader {
  const LibodeOf<Real>& ode;
  const GeomLayout& layout;
  const UserTests& tests;

  [[nodiscard]] int class_of(dxGeom* geom) const {
    return layout.is_known ? GeomLayout::at<std::int32_t>(geom, layout.type)
                           : ode.geom_get_class(geom);
  }
  /// Whether the class is one of the user's that asks about each pair.
  [[nodiscard]] bool asks(int number) const {
    return number >= geom_class::kFirstUser && tests[number - geom_class::kFirstUser] != nullptr;
  }
  /// Whether libode's walks do not pass the geom over: it is enabled and has a size.
  [[nodiscard]] bool takes_part(dxGeom* geom, int number) const {
    if (!layout.is_known) return ode.geom_is_enabled(geom) != 0 && !has_no_size(geom, number);
    const auto flags = GeomLayout::at<std::int32_t>(geom, layout.flags);
    return (flags & (layout.enabled | layout.zero_sized)) == layout.enabled;
  }
  /// Whether its space, which has been cleaned, has missed it: its bounds are old, and stay so.
  [[nodiscard]] bool is_stale(dxGeom* geom) const {
    return layout.is_known &&
           (GeomLayout::at<std::int32_t>(geom, layout.flags) & layout.dirty) != 0;
  }
  /// As libode's traversals have them once the space is clean.
  void read_bounds(dxGeom* geom, BoundsBox<Real>& box) const {
    if (layout.is_known) {
      box = GeomLayout::at<BoundsBox<Real>>(geom, layout.bounds);
    } else {
      ode.geom_get_aabb(geom, box.v);
    }
  }
  [[nodiscard]] const dxBody* body_of(dxGeom* geom) const {
    return layout.is_known
               ? static_cast<const dxBody*>(GeomLayout::at<const void*>(geom, layout.body))
               : ode.geom_get_body(geom);
  }
  [[nodiscard]] unsigned long category_of(dxGeom* geom) const {
    return layout.is_known ? GeomLayout::at<unsigned long>(geom, layout.category)
                           : ode.geom_get_category_bits(geom);
  }
  [[nodiscard]] unsigned long collide_of(dxGeom* geom) const {
    return layout.is_known ? GeomLayout::at<unsigned long>(geom, layout.collide)
                           : ode.geom_get_collide_bits(geom);
  }
  /// Of a class that has one. A pose relative to a body is computed.
  [[nodiscard]] const Real* position_of(dxGeom* geom) const {
    if (layout.is_known &&
        (GeomLayout::at<std::int32_t>(geom, layout.flags) & layout.pose_bad) == 0) {
      return GeomLayout::at<const Real*>(geom, layout.pose);
    }
    return ode.geom_get_position(geom);
  }
  /// Of a sphere.
  [[nodiscard]] Real radius_of(dxGeom* geom) const {
    return layout.is_known ? GeomLayout::at<Real>(geom, layout.radius)
                           : ode.sphere_get_radius(geom);
  }

 private:
  /// libode excludes geoms of size zero from its spaces; nobody may ask it for that flag.
  [[nodiscard]] bool has_no_size(dxGeom* geom, int number) const {
    Real size[4] = {};
    switch (number) {
      case geom_class::kSphere:
        return ode.sphere_get_radius(geom) == 0;
      case geom_class::kBox:
        ode.box_get_lengths(geom, size);
        return size[0] == 0 || size[1] == 0 || size[2] == 0;
      case geom_class::kCapsule:
        ode.capsule_get_params(geom, &size[0], &size[1]);
        return size[0] == 0;
      case geom_class::kCylinder:
        ode.cylinder_get_params(geom, &size[0], &size[1]);
        return size[0] == 0 || size[1] == 0;
      default:
        return false;
    }
  }
};

}  // namespace harpoon::ode
