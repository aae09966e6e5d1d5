// See the header.
#include <sim/input/objection_places.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {
namespace {

/// What is to be changed: the quantity where its map or load is said, otherwise the run, or the first line.
Place place_of(const YamlFile& file, const domain::Objection& objection) {
  const Node& run = file.root.find("runs")->children.at(objection.runs.front());
  for (const Node* from : {&run, static_cast<const Node*>(&file.root)}) {
    const Node* columns = from->find("columns");
    const Node* node = objection.quantity == "load" ? from->find("load")
                       : columns != nullptr         ? columns->find(objection.quantity)
                                                    : nullptr;
    if (node != nullptr) return node->place;
  }
  return run.place;
}

}  // namespace

std::vector<Problem> problems_of(const std::filesystem::path& path,
                                 const std::vector<domain::Objection>& objections) {
  if (objections.empty()) return {};
  Problems problems;
  const auto tell = [&](const Source& source, Place place, const domain::Objection& objection) {
    if (objection.certain)
      problems.error(source, place, objection.message);
    else
      problems.warning(source, place, objection.message);
  };
  const Source no_line(path.string(), "", {});
  try {
    const YamlFile file = load_yaml(path);
    for (const auto& objection : objections)
      if (objection.runs.empty())
        tell(no_line, {}, objection);
      else
        tell(file.source, place_of(file, objection), objection);
  } catch (const MissingInput&) {
    for (const auto& objection : objections) tell(no_line, nowhere, objection);
  }
  return problems.sorted();
}

}  // namespace mckibben::input
