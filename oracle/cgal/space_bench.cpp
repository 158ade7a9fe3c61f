// CPU time of one job in space, without reading inputs; the peer of examples/bench_space.rs.
//
//   space_bench build POINTS [THREADS] [COUNT]   bulk insertion (spatial sort inside) of the first COUNT points; THREADS is always 1
//   space_bench remove POINTS COUNT              build, then removal of COUNT points in random order
//   space_bench valid POINTS                     is_valid() of the build
//
// Points without weights go through Delaunay_triangulation_3, others through Regular_triangulation_3. Prints seconds, vertices, cells, and
// bytes of memory: the peak while the job ran less what was there before it.
#include "space.hpp"

static double memory(const char* key) {
  std::FILE* f = std::fopen("/proc/self/status", "r");
  char line[256];
  double kib = 0;
  while (f && std::fgets(line, sizeof line, f))
    if (std::string(line).rfind(key, 0) == 0) kib = std::atof(line + std::string(key).size());
  if (f) std::fclose(f);
  return kib * 1024;
}

template <class F> static void measure(F job, std::size_t vertices(const void*), std::size_t cells(const void*), const void* t) {
  if (std::FILE* f = std::fopen("/proc/self/clear_refs", "w")) std::fputs("5", f), std::fclose(f);
  const double before = memory("VmRSS:"), start = cpu_seconds();
  job();
  const double seconds = cpu_seconds() - start;
  std::printf("%.4f %zu %zu %.0f\n", seconds, vertices(t), cells(t), memory("VmHWM:") - before);
}

static std::vector<Id> shuffled(std::size_t n) {
  std::uint64_t state = 9;
  const auto word = [&] {
    state += 0x9E3779B97F4A7C15;
    std::uint64_t z = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  };
  std::vector<Id> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = Id(i);
  for (std::size_t i = n; i-- > 1;) std::swap(order[i], order[word() % (i + 1)]);
  return order;
}

template <class T> static int run(const std::string& mode, const std::vector<Row>& rows, std::size_t count) {
  T t;
  const auto vertices = [](const void* t) { return std::size_t(static_cast<const T*>(t)->number_of_vertices()); };
  const auto cells = [](const void* t) { return std::size_t(static_cast<const T*>(t)->number_of_finite_cells()); };
  if (mode == "build") {
    const auto points = points_of<T>(rows);
    measure([&] { t.insert(points.begin(), points.end()); }, vertices, cells, &t);
    return 0;
  }
  build(t, rows);
  if (mode == "valid") {
    bool valid = false;
    measure([&] { valid = t.is_valid(); }, vertices, cells, &t);
    return valid ? 0 : 1;
  }
  // Vertices in a random order of the input; hidden points have none and take no time.
  const std::vector<std::size_t> order = sorted_positions(rows);
  std::vector<typename T::Vertex_handle> handles(rows.size());
  for (auto v = t.finite_vertices_begin(); v != t.finite_vertices_end(); ++v) {
    const Row r = row_of(v->point());
    handles[*std::lower_bound(order.begin(), order.end(), r, [&](std::size_t i, const Row& r) { return rows[i] < r; })] = v;
  }
  const std::vector<Id> ids = shuffled(rows.size());
  measure([&] {
    for (std::size_t i = 0; i < std::min(count, ids.size()); ++i)
      if (handles[ids[i]] != typename T::Vertex_handle()) t.remove(handles[ids[i]]);
  }, vertices, cells, &t);
  return 0;
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::string mode = argv[1];
  std::vector<Row> rows = read_rows(argv[2]);
  const std::size_t count = argc > 4 ? std::atol(argv[4]) : argc > 3 && mode == "remove" ? std::atol(argv[3]) : 0;
  if (mode == "build" && count && count < rows.size()) rows.resize(count);
  const bool weighted = std::any_of(rows.begin(), rows.end(), [](const Row& r) { return r[3] != 0; });
  return weighted ? run<Regular3>(mode, rows, count) : run<Delaunay3>(mode, rows, count);
}
