/// @file
/// `homotopy_bench`: speed claims of the chapter, by Google Benchmark.

int main() { return 0; }
