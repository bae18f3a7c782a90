// Says what is wrong with a file, and writes a repaired copy: repair_file INPUT OUTPUT
#include <ccdt/ccdt.h>

#include <cstdio>
#include <string>

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: repair_file INPUT OUTPUT\n");
    return 2;
  }
  const ccdt::InputPlc input = ccdt::read_plc(argv[1]);
  for (const ccdt::repair::Fault& fault : ccdt::find_faults(input).faults)
    std::printf("%s %s: %llu\n", fault.is_error ? "error" : "note", ccdt::name_of(fault.kind).data(),
                static_cast<unsigned long long>(fault.count));

  // Lengths are in the units of the file.
  const ccdt::repair::Repaired repaired = ccdt::repair_input(input, {.gap = 0.001, .limit = 1});
  for (const ccdt::repair::RepairStep& step : repaired.steps)
    std::printf("%s: %llu\n", step.what.data(), static_cast<unsigned long long>(step.count));
  for (const std::string& refusal : repaired.refused) std::printf("not repaired: %s\n", refusal.c_str());
  std::printf("nothing moved farther than %g\n", repaired.certificate.displacement);
  ccdt::write_plc(repaired.input, argv[2]);

  const ccdt::repair::Diagnosis left = ccdt::find_faults(repaired.input);
  std::printf("%s: %llu region, volume %g\n", left.is_valid() ? "valid" : "not valid",
              static_cast<unsigned long long>(left.regions), left.volume);
} catch (const ccdt::Error& error) {
  std::fprintf(stderr, "%s\n%s\n", error.what(), error.remedy().c_str());
  return 1;
}
