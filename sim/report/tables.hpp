// Tables and paragraphs of a page. Text is escaped here.
#pragma once

#include <initializer_list>
#include <string>

namespace mckibben::report {

/// A row of a table. `head` may break after its underscores.
std::string row(const std::string& head, std::initializer_list<std::string> cells);
/// Shown on a click.
std::string folded(const std::string& summary, const std::string& html);
std::string table(const std::string& caption, std::initializer_list<const char*> head,
                  const std::string& rows);
std::string paragraph(const std::string& text);

}  // namespace mckibben::report
