// Refinement with CGAL's Mesh_2 and the quality of what comes out.
#pragma once
#include "common.hpp"
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <cmath>

using MeshTds = CGAL::Triangulation_data_structure_2<CGAL::Delaunay_mesh_vertex_base_2<K>, CGAL::Delaunay_mesh_face_base_2<K>>;
using MeshTriangulation = CGAL::Constrained_Delaunay_triangulation_2<K, MeshTds, CGAL::No_constraint_intersection_requiring_constructions_tag>;

// Angle and area, in the manner of CGAL's own criteria: the quality is (squared sine of the smallest angle, area over its bound), larger
// triangles first. (Delaunay_mesh_area_criteria_2 of CGAL 5.5 orders areas as if they were normalised and does not end here.)
class Criteria : public CGAL::Delaunay_mesh_size_criteria_2<MeshTriangulation> {
  using Base = CGAL::Delaunay_mesh_size_criteria_2<MeshTriangulation>;
  double largest;

public:
  Criteria(double sine2, double area) : largest(area) { this->set_bound(sine2); }

  struct Is_bad : Base::Is_bad {
    double largest;
    Is_bad(double sine2, double area) : Base::Is_bad(sine2, 0, K()), largest(area) {}
    using Base::Is_bad::operator();
    CGAL::Mesh_2::Face_badness operator()(const MeshTriangulation::Face_handle& f, Base::Quality& q) const {
      const Point &a = f->vertex(0)->point(), &b = f->vertex(1)->point(), &c = f->vertex(2)->point();
      const double area = CGAL::area(a, b, c);
      std::array<double, 3> edges{CGAL::squared_distance(a, b), CGAL::squared_distance(b, c), CGAL::squared_distance(c, a)};
      std::sort(edges.begin(), edges.end());
      q.first = 4 * area * area / (edges[1] * edges[2]);
      q.second = largest > 0 ? area / largest : 0;
      return (*this)(q);
    }
  };
  Is_bad is_bad_object() const { return Is_bad(this->bound(), largest); }
};

// Refines all that constraints enclose, less the faces of the hole seeds. area 0: no bound. Stops after max_steps if that is not negative.
// Returns whether it came to an end.
inline bool refine_by_area(MeshTriangulation& t, const std::vector<Point>& holes, double area, double degrees, long max_steps = -1) {
  const double sine = std::sin(degrees * 3.14159265358979323846 / 180);
  CGAL::Delaunay_mesher_2<MeshTriangulation, Criteria> mesher(t, Criteria(sine * sine, area));
  mesher.set_seeds(holes.begin(), holes.end(), false);
  if (max_steps < 0) { mesher.refine_mesh(); return true; }
  mesher.init();
  for (long i = 0; i < max_steps; ++i)
    if (!mesher.try_one_step_refine_mesh()) return true;
  return false;
}

struct Quality {
  std::size_t triangles = 0;
  double smallest_angle = 180;
  double largest_area = 0;
};

// Of the faces in the domain; displays only.
inline Quality quality(const MeshTriangulation& t) {
  Quality q;
  for (auto f = t.finite_faces_begin(); f != t.finite_faces_end(); ++f) {
    if (!f->is_in_domain()) continue;
    ++q.triangles;
    for (int i = 0; i < 3; ++i) {
      const auto a = f->vertex(i)->point(), b = f->vertex((i + 1) % 3)->point(), c = f->vertex((i + 2) % 3)->point();
      const auto u = b - a, v = c - a;
      const double cross = u.x() * v.y() - u.y() * v.x();
      q.smallest_angle = std::min(q.smallest_angle, std::atan2(cross, u * v) * 180 / 3.14159265358979323846);
      q.largest_area = std::max(q.largest_area, cross / 2);
    }
  }
  return q;
}
