// Delaunay and constrained Delaunay triangulations of many cases, as sorted sets of triangles.
//
// Input (stdin): cases in the format of oracle/README.md. Vertices are inserted one by one in the order given, constraints after them.
// Output: for each case its name, the number of triangles and the triangles, each as three ascending labels, ascending.
// A vertex on a segment divides it; a case whose segments cross is refused. A case without segments goes through Delaunay_triangulation_2, and through the constrained one too: both must agree.
#include "common.hpp"
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

using Vertex = CGAL::Triangulation_vertex_base_with_info_2<long, K>;
using Tds = CGAL::Triangulation_data_structure_2<Vertex>;
using Delaunay = CGAL::Delaunay_triangulation_2<K, Tds>;
using Face = CGAL::Constrained_triangulation_face_base_2<K>;
using ConstrainedTds = CGAL::Triangulation_data_structure_2<Vertex, Face>;
using Constrained = CGAL::Constrained_Delaunay_triangulation_2<K, ConstrainedTds, CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Set = std::vector<std::array<long, 3>>;

template <class T> Set triangles(const T& t) {
  Set set;
  for (auto f = t.finite_faces_begin(); f != t.finite_faces_end(); ++f) {
    std::array<long, 3> v{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
    std::sort(v.begin(), v.end());
    set.push_back(v);
  }
  std::sort(set.begin(), set.end());
  return set;
}

template <class T> std::vector<typename T::Vertex_handle> insert(T& t, const std::vector<Point>& points, const std::vector<long>& labels) {
  std::vector<typename T::Vertex_handle> handles;
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto v = t.insert(points[i]);
    v->info() = labels[i];
    handles.push_back(v);
  }
  return handles;
}

int main() {
  std::ios::sync_with_stdio(false);
  std::string word, name;
  std::size_t n, m, h;
  while (std::cin >> word >> name >> n >> m >> h) {
    std::vector<Point> points;
    std::vector<long> labels;
    for (std::size_t i = 0; i < n; ++i) {
      long label;
      std::string x, y;
      std::cin >> label >> x >> y;
      labels.push_back(label);
      points.emplace_back(std::strtod(x.c_str(), nullptr), std::strtod(y.c_str(), nullptr));
    }
    Constrained constrained;
    const auto handles = insert(constrained, points, labels);
    std::vector<std::pair<std::size_t, std::size_t>> segments(m);
    for (auto& [u, v] : segments) std::cin >> u >> v;
    for (std::size_t i = 0; i < 2 * h; ++i) std::cin >> word;  // hole seeds play no role
    try {
      for (const auto& [u, v] : segments)
        if (u != v) constrained.insert_constraint(handles[u], handles[v]);
    } catch (const Constrained::Intersection_of_constraints_exception&) {
      std::cout << "case " << name << " refused\n";
      continue;
    }
    const Set set = triangles(constrained);
    if (m == 0) {
      Delaunay delaunay;
      insert(delaunay, points, labels);
      if (triangles(delaunay) != set) std::cerr << name << ": the two classes of CGAL differ\n";
    }
    std::cout << "case " << name << ' ' << set.size() << '\n';
    for (const auto& t : set) std::cout << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  }
}
