// The timeline of --trace: Chrome trace events, one line each.

#include <fmt/format.h>

#include <iterator>

#include "app/report.h"

namespace yat {

namespace {

// Thread ids: the phases in one row, the workers below it.
constexpr uint32_t kPhaseRow = 0, kFirstWorkerRow = 1;

void add_thread_name(std::string& out, uint32_t row, std::string_view name) {
  fmt::format_to(std::back_inserter(out),
                 R"({{"name":"thread_name","ph":"M","pid":1,"tid":{},"args":{{"name":"{}"}}}})"
                 ",\n",
                 row, name);
}

void add_phase(std::string& out, std::string_view name, double begin, double seconds) {
  fmt::format_to(std::back_inserter(out),
                 R"({{"name":"{}","ph":"X","pid":1,"tid":{},"ts":{:.3f},"dur":{:.3f}}})"
                 ",\n",
                 name, kPhaseRow, begin * 1e6, seconds * 1e6);
}

}  // namespace

std::string trace_json(const RenderReport& report) {
  const PhaseTimes& time = report.time;
  const double render_begin = time.read + time.build;
  std::string out = "{\"displayTimeUnit\":\"ns\",\"traceEvents\":[\n";
  out.reserve(report.totals.trace.size() * 110 + 4096);
  add_thread_name(out, kPhaseRow, "phases");
  for (uint32_t worker = 0; worker < report.threads; ++worker)
    add_thread_name(out, kFirstWorkerRow + worker, fmt::format("worker {}", worker));
  add_phase(out, "read", 0, time.read);
  add_phase(out, "build", time.read, time.build);
  add_phase(out, "render", render_begin, time.render);
  add_phase(out, "write", render_begin + time.render, time.write);
  for (const TraceSpan& span : report.totals.trace)
    fmt::format_to(std::back_inserter(out),
                   R"({{"name":"{}","ph":"X","pid":1,"tid":{},"ts":{:.3f},"dur":{:.3f},)"
                   R"("args":{{"rows":{}}}}})"
                   ",\n",
                   stage_name(span.stage), kFirstWorkerRow + span.worker,
                   render_begin * 1e6 + double(span.begin_ns) * 1e-3,
                   double(span.end_ns - span.begin_ns) * 1e-3, span.rows);
  out.resize(out.size() - 2);
  out += "\n]}\n";
  return out;
}

}  // namespace yat
