// What the CGAL programs of space share: points with weights, cases, and the canonical answer.
#pragma once
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Regular_triangulation_3.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <unordered_map>
#include <vector>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay3 = CGAL::Delaunay_triangulation_3<K>;
using Regular3 = CGAL::Regular_triangulation_3<K>;
using Weighted = Regular3::Weighted_point;
using Id = std::uint32_t;
using Row = std::array<double, 4>;  // x, y, z, weight

inline double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

[[noreturn]] inline void fail(const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  std::exit(2);
}

// -0 is 0: equal places are equal bytes.
inline Row plain(Row r) {
  for (double& x : r) x += 0.0;
  return r;
}

inline Row row_of(const Delaunay3::Point& p) { return plain({p.x(), p.y(), p.z(), 0}); }
inline Row row_of(const Weighted& p) { return plain({p.x(), p.y(), p.z(), p.weight()}); }

template <class P> P make_point(const Row& r);
template <> inline Delaunay3::Point make_point(const Row& r) { return {r[0], r[1], r[2]}; }
template <> inline Weighted make_point(const Row& r) { return {K::Point_3(r[0], r[1], r[2]), r[3]}; }

template <class T> std::vector<typename T::Point> points_of(const std::vector<Row>& rows) {
  std::vector<typename T::Point> points;
  points.reserve(rows.size());
  for (const Row& r : rows) points.push_back(make_point<typename T::Point>(r));
  return points;
}

template <class T> void build(T& t, const std::vector<Row>& rows) {
  const auto points = points_of<T>(rows);
  t.insert(points.begin(), points.end());
}

// The points that stand, under their ids, in the order of ids.
struct Standing {
  std::vector<Id> ids;
  std::vector<Row> rows;
};

// Dimension (-1 without points), simplices as ascending tuples in ascending order, hidden points, duplicates with what stands for them.
struct Answer {
  std::int32_t dimension = -1;
  std::vector<Id> simplices, hidden, duplicates;
  bool operator==(const Answer& o) const {
    return dimension == o.dimension && simplices == o.simplices && hidden == o.hidden && duplicates == o.duplicates;
  }
};

// Positions of the points sorted by place, weight, id: equal points side by side, the smallest id first.
inline std::vector<std::size_t> sorted_positions(const std::vector<Row>& rows) {
  std::vector<std::size_t> order(rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return rows[i] < rows[j]; });
  return order;
}

template <class T> Answer answer(const T& t, const Standing& s) {
  const std::vector<std::size_t> order = sorted_positions(s.rows);
  const auto position_of = [&](const Row& r) {
    const auto i = std::lower_bound(order.begin(), order.end(), r, [&](std::size_t i, const Row& r) { return s.rows[i] < r; });
    if (i == order.end() || s.rows[*i] != r) fail("a vertex that is no point of the input");
    return *i;
  };
  Answer a;
  a.dimension = t.dimension();
  std::vector<char> is_vertex(s.rows.size(), 0);
  std::unordered_map<const void*, Id> id;
  for (auto v = t.finite_vertices_begin(); v != t.finite_vertices_end(); ++v) {
    const std::size_t i = position_of(row_of(v->point()));
    is_vertex[i] = 1;
    id[&*v] = s.ids[i];
  }
  std::vector<std::array<Id, 4>> tuples;
  const auto add = [&](auto... vertices) {
    std::array<Id, 4> tuple{};
    std::size_t k = 0;
    ((tuple[k++] = id.at(&*vertices)), ...);
    std::sort(tuple.begin(), tuple.begin() + k);
    tuples.push_back(tuple);
  };
  if (t.dimension() == 3)
    for (auto c = t.finite_cells_begin(); c != t.finite_cells_end(); ++c) add(c->vertex(0), c->vertex(1), c->vertex(2), c->vertex(3));
  if (t.dimension() == 2)
    for (auto f = t.finite_facets_begin(); f != t.finite_facets_end(); ++f)
      add(f->first->vertex((f->second + 1) & 3), f->first->vertex((f->second + 2) & 3), f->first->vertex((f->second + 3) & 3));
  if (t.dimension() == 1)
    for (auto e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) add(e->first->vertex(e->second), e->first->vertex(e->third));
  if (t.dimension() == 0) add(t.finite_vertices_begin());
  std::sort(tuples.begin(), tuples.end());
  for (const auto& tuple : tuples) a.simplices.insert(a.simplices.end(), tuple.begin(), tuple.begin() + t.dimension() + 1);
  std::vector<std::pair<Id, Id>> duplicates;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t first = position_of(s.rows[order[k]]);
    if (first != order[k]) duplicates.emplace_back(s.ids[order[k]], s.ids[first]);
    else if (!is_vertex[first]) a.hidden.push_back(s.ids[first]);
  }
  std::sort(a.hidden.begin(), a.hidden.end());
  std::sort(duplicates.begin(), duplicates.end());
  for (const auto& [i, of] : duplicates) a.duplicates.insert(a.duplicates.end(), {i, of});
  return a;
}

// A file of N rows of little-endian doubles: x, y, z, weight.
inline std::vector<Row> read_rows(const char* path) {
  std::FILE* f = std::fopen(path, "rb");
  if (!f) fail(std::string("cannot read ") + path);
  std::fseek(f, 0, SEEK_END);
  std::vector<Row> rows(std::size_t(std::ftell(f)) / sizeof(Row));
  std::rewind(f);
  if (std::fread(rows.data(), sizeof(Row), rows.size(), f) != rows.size()) fail("short read");
  std::fclose(f);
  return rows;
}
