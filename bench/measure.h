#pragma once
// Clocks, medians and memory of this process, for the programs that time things in turn.

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace yat::bench {

using Json = nlohmann::ordered_json;

/// Processor time of this thread [s]: what a kernel costs, also on a machine that others use.
double thread_seconds();
/// Processor time of all threads of this process [s].
double process_seconds();
/// Time that passes [s].
double wall_seconds();

/// The middle value; the mean of the two middle ones of an even number. 0 of none.
double median(std::vector<double> values);
/// exp of the mean logarithm; 0 of none. Values > 0.
double geometric_mean(const std::vector<double>& values);

/// Memory of this process that is in main memory now [bytes].
uint64_t resident_bytes();
/// The most of it since the last reset_peak_bytes() [bytes].
uint64_t peak_resident_bytes();
/// Hands freed memory back to the system and lets the peak start anew. False where the system
/// cannot (it needs Linux's /proc/self/clear_refs): the peak is then that of the whole process.
bool reset_peak_bytes();

/// What a result file says of where it comes from: {"program", "date", "commit", "compiler",
/// "flags", "machine": {"cpu", "cores", "memory"}}.
Json origin(const std::string& program);

/// What main() returns: run's answer, or, after one line on stderr, 2 for a wrong option, 3 for
/// memory that is not there, 1 for every other error.
int run_program(const char* name, int (*run)(int, char**), int argc, char** argv);

/// Writes the file whole or not at all. Throws Error "file: error: ...".
void write_json(const std::string& file, const Json& json);

}  // namespace yat::bench
