// Delaunay and regular triangulations of many cases of space, as canonical sets. Formats: oracle/README.md, "Cases of space".
//
// A case is built at once from the points that stand after its edits. Without weights it goes through Delaunay_triangulation_3, and (up to
// 20,000 points) through Regular_triangulation_3 too: both must agree.
#include "space.hpp"

static std::FILE* const in = stdin;

template <class T> static bool read(T* data, std::size_t n) { return std::fread(data, sizeof(T), n, in) == n; }

static Id number() {
  Id n;
  if (!read(&n, 1)) fail("the stream ends within a case");
  return n;
}

static Standing standing(const std::vector<Row>& points) {
  std::vector<Row> rows;
  std::vector<char> there;
  const Id edits = number();
  if (edits == 0) {
    rows = points;
    there.assign(rows.size(), 1);
  }
  for (Id i = 0; i < edits; ++i) {
    const Id kind = number(), id = number();
    double weight;
    if (!read(&weight, 1)) fail("the stream ends within an edit");
    if (kind == 0) rows.push_back(points.at(id)), there.push_back(1);
    if (kind == 1) there.at(id) = 0;
    if (kind == 2) rows.at(id)[3] = weight;
  }
  Standing s;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (there[i]) s.ids.push_back(Id(i)), s.rows.push_back(plain(rows[i]));
  return s;
}

static void write(const std::vector<Id>& list) {
  const Id n = Id(list.size());
  std::fwrite(&n, sizeof n, 1, stdout);
  std::fwrite(list.data(), sizeof(Id), list.size(), stdout);
}

template <class T> static Answer solve(const Standing& s) {
  T t;
  build(t, s.rows);
  return answer(t, s);
}

int main() {
  Id length;
  while (read(&length, 1)) {
    std::string name(length, ' ');
    if (!read(name.data(), length)) fail("the stream ends within a name");
    std::vector<Row> points(number());
    if (!read(points.data(), points.size())) fail("the stream ends within points");
    const Standing s = standing(points);
    const bool weighted = std::any_of(s.rows.begin(), s.rows.end(), [](const Row& r) { return r[3] != 0; });
    const Answer a = weighted ? solve<Regular3>(s) : solve<Delaunay3>(s);
    if (!weighted && s.rows.size() <= 20000 && !(a == solve<Regular3>(s)))
      std::fprintf(stderr, "%s: the two classes of CGAL differ\n", name.c_str());
    std::fwrite(&length, sizeof length, 1, stdout);
    std::fwrite(name.data(), 1, length, stdout);
    std::fwrite(&a.dimension, sizeof a.dimension, 1, stdout);
    for (const auto* list : {&a.simplices, &a.hidden, &a.duplicates}) write(*list);
    std::fflush(stdout);
  }
}
