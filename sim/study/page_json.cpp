// See the header.
#include <sim/output/json_parts.hpp>
#include <sim/study/page_json.hpp>

namespace mckibben::study {

input::Json json_of(const Tally& tally) {
  return {{"mean", tally.mean()}, {"standard_deviation", tally.deviation()}, {"rows", tally.count()}};
}

std::string document_of(const Evidence& evidence, const std::string& name, const input::Json& numbers) {
  input::Json document = output::heading_json("mckibben-study/1", evidence.dataset.inputs);
  document["study"] = name;
  document["runs_failed"] = evidence.failed;
  document.update(numbers);
  return output::text_of(document);
}

}  // namespace mckibben::study
