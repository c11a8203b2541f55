#include "converge/record.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace yat {

namespace {

using Json = nlohmann::ordered_json;

double number(const Json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Json record_json(const RunRecord& record) {
  Json object = {{"variant", record.variant},
                 {"run", record.run},
                 {"seed", record.seed},
                 {"spp", record.spp},
                 {"samples_per_pixel", record.samples_per_pixel}};
  object.update(record.details.empty() ? Json::object() : Json::parse(record.details));
  object["time"]["render"] = record.seconds;
  object["cpu_time"] = record.cpu_seconds;
  const ImageError& e = record.error;
  object["error"] = {{"mse", e.mse},
                     {"relmse", e.rel_mse},
                     {"relmse_trimmed", e.rel_mse_trimmed},
                     {"mape", e.mape},
                     {"bias", e.bias},
                     {"flip", record.hdr_flip ? Json(*record.hdr_flip) : Json()},
                     {"outliers", e.outliers},
                     {"not_finite", e.not_finite},
                     {"eps", e.epsilon}};
  object["ttuv"] = e.mse * record.seconds;
  return object;
}

RunRecord record_of(const Json& object) {
  RunRecord record;
  try {
    record.variant = object.at("variant").get<std::string>();
    record.run = object.at("run").get<uint32_t>();
    record.seed = object.at("seed").get<uint32_t>();
    record.spp = object.at("spp").get<uint32_t>();
    record.samples_per_pixel = object.at("samples_per_pixel").get<double>();
    record.seconds = object.at("time").at("render").get<double>();
    record.cpu_seconds = object.at("cpu_time").get<double>();
    const Json& e = object.at("error");
    record.error.mse = number(e.at("mse"));
    record.error.rel_mse = number(e.at("relmse"));
    record.error.rel_mse_trimmed = number(e.at("relmse_trimmed"));
    record.error.mape = number(e.at("mape"));
    record.error.bias = number(e.at("bias"));
    record.error.epsilon = number(e.at("eps"));
    record.error.outliers = e.at("outliers").get<uint64_t>();
    record.error.not_finite = e.at("not_finite").get<uint64_t>();
    if (e.at("flip").is_number()) record.hdr_flip = e.at("flip").get<double>();
  } catch (const nlohmann::json::exception& error) {
    throw Error(fmt::format("not the record of a run ({})", error.what()));
  }
  // What record_json() puts in is written again from the fields.
  record.details = object.dump(-1, ' ', false, Json::error_handler_t::replace);
  return record;
}

std::string_view csv_header() {
  return "variant,spp,run,seed,seconds,cpu_seconds,mse,relmse,relmse_trimmed,mape,bias,hdr_flip,"
         "outliers,ttuv,samples_per_pixel";
}

std::string csv_line(const RunRecord& record) {
  std::string name;
  for (const char letter : record.variant) {
    if (letter == '"') name += '"';
    name += letter;
  }
  const ImageError& e = record.error;
  return fmt::format(
      "\"{}\",{},{},{},{:.6f},{:.6f},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{},{},{:.9g},{:.9g}", name,
      record.spp, record.run, record.seed, record.seconds, record.cpu_seconds, e.mse, e.rel_mse,
      e.rel_mse_trimmed, e.mape, e.bias,
      record.hdr_flip ? fmt::format("{:.9g}", *record.hdr_flip) : "", e.outliers,
      e.mse * record.seconds, record.samples_per_pixel);
}

}  // namespace yat
