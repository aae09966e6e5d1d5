// See the header.
#include <sim/input/finding_places.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {
namespace {

/// What is to be changed: the quantity where its map or load is said, otherwise the run, or the first line.
Place place_of(const YamlFile& file, const data::Finding& finding) {
  const Node& run = file.root.find("runs")->children.at(finding.runs.front());
  for (const Node* from : {&run, static_cast<const Node*>(&file.root)}) {
    const Node* columns = from->find("columns");
    const Node* node = finding.quantity == "load" ? from->find("load")
                       : columns != nullptr       ? columns->find(finding.quantity)
                                                  : nullptr;
    if (node != nullptr) return node->place;
  }
  return run.place;
}

}  // namespace

std::vector<Problem> problems_of(const std::filesystem::path& path,
                                 const std::vector<data::Finding>& findings) {
  if (findings.empty()) return {};
  Problems problems;
  const auto tell = [&](const Source& source, Place place, const data::Finding& finding) {
    if (data::is_error(finding))
      problems.error(source, place, finding.message);
    else
      problems.warning(source, place, finding.message);
  };
  const Source no_line(path.string(), "", {});
  try {
    const YamlFile file = load_yaml(path);
    for (const auto& finding : findings)
      if (finding.runs.empty())
        tell(no_line, {}, finding);
      else
        tell(file.source, place_of(file, finding), finding);
  } catch (const MissingInput&) {
    for (const auto& finding : findings) tell(no_line, nowhere, finding);
  }
  return problems.sorted();
}

}  // namespace mckibben::input
