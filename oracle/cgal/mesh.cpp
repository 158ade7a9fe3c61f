// Mesh_2 on one case: counts and smallest angle.
//
//   mesh DEGREES AREA MAX_STEPS < CASES
//
// Input: cases in the format of oracle/README.md with hole seeds. Prints: name, ended (1) or cut off (0), vertices, triangles, smallest
// angle, largest area, CPU seconds.
#include "mesh.hpp"

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const double degrees = std::atof(argv[1]), area = std::atof(argv[2]);
  const long max_steps = std::atol(argv[3]);
  std::string word, name;
  std::size_t n, m, h = 0;
  const auto number = [] { std::string s; std::cin >> s; return std::strtod(s.c_str(), nullptr); };
  while (std::cin >> word >> name >> n >> m >> h) {
    MeshTriangulation t;
    std::vector<MeshTriangulation::Vertex_handle> handles;
    for (std::size_t i = 0; i < n; ++i) {
      number();
      const double x = number(), y = number();
      handles.push_back(t.insert(Point(x, y)));
    }
    for (std::size_t i = 0; i < m; ++i) {
      const auto u = std::size_t(number()), v = std::size_t(number());
      if (handles[u] != handles[v]) t.insert_constraint(handles[u], handles[v]);
    }
    std::vector<Point> holes;
    for (std::size_t i = 0; i < h; ++i) {
      const double x = number(), y = number();
      holes.emplace_back(x, y);
    }
    const double start = cpu_seconds();
    const bool ended = refine_by_area(t, holes, area, degrees, max_steps);
    const double seconds = cpu_seconds() - start;
    const Quality q = quality(t);
    std::printf("%s %d %zu %zu %.4f %.6g %.3f\n", name.c_str(), int(ended), std::size_t(t.number_of_vertices()), q.triangles,
                q.smallest_angle, q.largest_area, seconds);
  }
}
