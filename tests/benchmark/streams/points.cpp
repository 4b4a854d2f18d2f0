// The same random points in any form a stream has: points FORM COUNT > FILE
//   ndjson  {"id":"p1","x":1.25,"y":-3.5,"z":10.75}
//   csv     id,x,y,z with a header
//   text    "x y z" on a line
//   f64     little-endian x, y, z
// Numbers have three decimals, from -50 to 50.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("usage: points ndjson|csv|text|f64 COUNT\n", stderr), 2;
  const std::string form = argv[1];
  const long count = std::strtol(argv[2], nullptr, 10);
  std::mt19937_64 random(1);  // the standard says what it gives
  const auto thousandths = [&] { return static_cast<long>(random() % 100001) - 50000; };
  if (form == "csv") std::puts("id,x,y,z");
  for (long i = 1; i <= count; ++i) {
    const long x = thousandths(), y = thousandths(), z = thousandths();
    const double point[] = {static_cast<double>(x) / 1000, static_cast<double>(y) / 1000,
                            static_cast<double>(z) / 1000};
    if (form == "ndjson")
      std::printf("{\"id\":\"p%ld\",\"x\":%.6g,\"y\":%.6g,\"z\":%.6g}\n", i, point[0], point[1], point[2]);
    else if (form == "csv")
      std::printf("p%ld,%.6g,%.6g,%.6g\n", i, point[0], point[1], point[2]);
    else if (form == "text")
      std::printf("%.6g %.6g %.6g\n", point[0], point[1], point[2]);
    else if (form == "f64")
      std::fwrite(point, sizeof(double), 3, stdout);
    else
      return std::fputs("points: no such form\n", stderr), 2;
  }
  return std::fflush(stdout) == 0 ? 0 : 1;
}
