// Writes a made-up sweep, to measure and to look at its report: write_made_up_sweep DIR INPUTS RUNS. Each input has 20
// cases.
#include <cstdio>
#include <cstdlib>

#include "reports/tests/made_up_sweep.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: write_made_up_sweep DIR INPUTS RUNS\n", stderr);
    return 2;
  }
  const int inputs = std::atoi(argv[2]);
  ccdt::MadeUpSweep sweep{.sizes = 8, .lattices = {"fcc", "bcc", "sc"}, .runs = std::atoi(argv[3])};
  sweep.locators = {"cavity", "octree", "grid", "exhaustive", "kd-tree", "hash"};
  sweep.files = inputs > 24 ? inputs - 24 : 0;
  ccdt::write_made_up_sweep(sweep, argv[1]);
}
