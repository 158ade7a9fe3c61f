// Writes the (weighted) Delaunay triangulation of points as a mesh: space_mesh POINTS MESH
//
// POINTS: rows of four little-endian doubles x, y, z, weight. MESH: Medit text, vertices in the order of the input, cells positively oriented.
#include "space.hpp"
#include <map>

template <class T> static void write(const std::vector<Row>& rows, const char* path) {
  T t;
  build(t, rows);
  std::map<Row, std::size_t> place;
  for (std::size_t i = 0; i < rows.size(); ++i) place.emplace(plain(rows[i]), i + 1);
  std::FILE* f = std::fopen(path, "w");
  if (!f) fail("cannot write");
  std::fprintf(f, "MeshVersionFormatted 2\nDimension 3\nVertices\n%zu\n", rows.size());
  for (const Row& r : rows) std::fprintf(f, "%.17g %.17g %.17g 0\n", r[0], r[1], r[2]);
  std::fprintf(f, "Tetrahedra\n%zu\n", std::size_t(t.number_of_finite_cells()));
  for (auto c = t.finite_cells_begin(); c != t.finite_cells_end(); ++c) {
    for (int i = 0; i < 4; ++i) std::fprintf(f, "%zu ", place.at(row_of(c->vertex(i)->point())));
    std::fprintf(f, "0\n");
  }
  std::fprintf(f, "End\n");
  std::fclose(f);
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::vector<Row> rows = read_rows(argv[1]);
  const bool weighted = std::any_of(rows.begin(), rows.end(), [](const Row& r) { return r[3] != 0; });
  weighted ? write<Regular3>(rows, argv[2]) : write<Delaunay3>(rows, argv[2]);
}
