// CPU time of one build, without reading and writing.
//
//   bench delaunay POINTS            bulk insertion (spatial sort inside)
//   bench constrained POINTS SEGMENTS
//   bench refine SHAPE AREA DEGREES  Mesh_2 of the square or the quad of examples/bench.rs
//
// POINTS: pairs of little-endian f64; SEGMENTS: pairs of u32. Prints seconds, vertices, triangles, smallest angle (refine).
#include "common.hpp"
#include "mesh.hpp"
#include <CGAL/Delaunay_triangulation_2.h>

static void delaunay(const char* path) {
  const auto points = read_points(path);
  const double start = cpu_seconds();
  CGAL::Delaunay_triangulation_2<K> t(points.begin(), points.end());
  std::printf("%.4f %zu %zu\n", cpu_seconds() - start, std::size_t(t.number_of_vertices()), std::size_t(t.number_of_faces()));
}

static void constrained(const char* path, const char* segments_path) {
  using T = CGAL::Constrained_Delaunay_triangulation_2<K, CGAL::Default, CGAL::No_constraint_intersection_requiring_constructions_tag>;
  const auto points = read_points(path);
  const auto ids = read_binary<std::uint32_t>(segments_path);
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  for (std::size_t i = 0; i + 1 < ids.size(); i += 2) segments.emplace_back(ids[i], ids[i + 1]);
  const double start = cpu_seconds();
  T t;
  t.insert_constraints(points.begin(), points.end(), segments.begin(), segments.end());
  std::printf("%.4f %zu %zu\n", cpu_seconds() - start, std::size_t(t.number_of_vertices()), std::size_t(t.number_of_faces()));
}

static void refine(bool square, double area, double degrees) {
  const std::vector<Point> corners = square ? std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}
                                            : std::vector<Point>{{0, 0}, {1, 0.125}, {0.875, 1.0625}, {-0.0625, 0.9375}};
  const double start = cpu_seconds();
  MeshTriangulation t;
  t.insert_constraint(corners.begin(), corners.end(), true);
  refine_by_area(t, {}, area, degrees);
  const double seconds = cpu_seconds() - start;
  const Quality q = quality(t);
  std::printf("%.4f %zu %zu %.4f\n", seconds, std::size_t(t.number_of_vertices()), q.triangles, q.smallest_angle);
}

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  if (mode == "delaunay" && argc == 3) delaunay(argv[2]);
  else if (mode == "constrained" && argc == 4) constrained(argv[2], argv[3]);
  else if (mode == "refine" && argc == 5) refine(std::string(argv[2]) == "square", std::atof(argv[3]), std::atof(argv[4]));
  else return 2;
}
