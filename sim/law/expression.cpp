// The grammar, and what its rules leave behind; see the header.
#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <tao/pegtl.hpp>

#include <sim/law/expression.hpp>

namespace mckibben::law {
namespace {

namespace pegtl = tao::pegtl;
using Kind = Piece::Kind;

namespace grammar {

using namespace pegtl;

struct blanks : star<space> {};
struct exponent_of_ten : seq<one<'e', 'E'>, opt<one<'+', '-'>>, plus<digit>> {};
struct number : seq<sor<seq<plus<digit>, opt<one<'.'>, star<digit>>>, seq<one<'.'>, plus<digit>>>,
                    opt<exponent_of_ten>> {};
struct unit : plus<not_one<'[', ']'>> {};
struct end_of_unit : one<']'> {};
struct literal : seq<number, blanks, opt<if_must<one<'['>, unit, end_of_unit>>> {};

struct comparison;
struct argument : seq<blanks, comparison, blanks> {};
struct next_argument : if_must<one<','>, argument> {};
struct begin_call : one<'('> {};
struct end_call : one<')'> {};
struct name : identifier {};
struct called : if_must<begin_call, argument, star<next_argument>, end_call> {};
struct named : seq<name, opt<blanks, called>> {};
struct end_group : one<')'> {};
struct group : if_must<one<'('>, blanks, comparison, blanks, end_group> {};
struct operand : sor<literal, named, group> {};

struct power;
struct minus_exponent;
struct exponent : sor<minus_exponent, power> {};
struct minus_exponent : if_must<one<'-'>, blanks, exponent> {};
struct raised : if_must<one<'^'>, blanks, exponent> {};
struct power : seq<operand, opt<blanks, raised>> {};
struct factor;
struct negated : if_must<one<'-'>, blanks, factor> {};
struct factor : sor<negated, power> {};
struct times : if_must<one<'*'>, blanks, factor> {};
struct over : if_must<one<'/'>, blanks, factor> {};
struct product : seq<factor, star<blanks, sor<times, over>>> {};
struct plus_ : if_must<one<'+'>, blanks, product> {};
struct minus_ : if_must<one<'-'>, blanks, product> {};
struct sum : seq<product, star<blanks, sor<plus_, minus_>>> {};
struct at_most : if_must<string<'<', '='>, blanks, sum> {};
struct below : if_must<one<'<'>, blanks, sum> {};
struct at_least : if_must<string<'>', '='>, blanks, sum> {};
struct above : if_must<one<'>'>, blanks, sum> {};
struct comparison : seq<sum, opt<blanks, sor<at_most, below, at_least, above>>> {};
struct law : must<blanks, comparison, blanks, eof> {};

}  // namespace grammar

constexpr const char* operand_wanted = "a number, a name or a bracket is wanted here";

// What is said where a rule was needed and did not fit.
template <class Rule>
constexpr const char* message = operand_wanted;
template <>
constexpr const char* message<grammar::unit> = "a unit is wanted here, as in 0.1 [m/s]";
template <>
constexpr const char* message<grammar::end_of_unit> = "the unit's bracket [ is never closed";
template <>
constexpr const char* message<grammar::end_call> =
    "a comma or the closing bracket ) of the function is wanted here";
template <>
constexpr const char* message<grammar::end_group> = "the bracket ( is not closed where ) is wanted";
template <>
constexpr const char* message<pegtl::eof> = "the law should end here, or go on with an operator";

template <class Rule>
struct Control : pegtl::normal<Rule> {
  template <class Input, class... Left>
  [[noreturn]] static void raise(const Input& in, Left&&...) {
    throw pegtl::parse_error(message<Rule>, in);
  }
};

struct Left {
  std::vector<Piece> pieces{};
  struct Call {
    std::size_t offset;
    std::string name;
    std::size_t arguments;
  };
  std::vector<Call> open{};
};

template <class Rule>
struct Action : pegtl::nothing<Rule> {};

template <Kind kind>
struct Operator {
  static void apply(const auto& in, Left& left) { left.pieces.push_back({kind, in.position().byte}); }
};
template <>
struct Action<grammar::negated> : Operator<Kind::negate> {};
template <>
struct Action<grammar::minus_exponent> : Operator<Kind::negate> {};
template <>
struct Action<grammar::raised> : Operator<Kind::power> {};
template <>
struct Action<grammar::times> : Operator<Kind::multiply> {};
template <>
struct Action<grammar::over> : Operator<Kind::divide> {};
template <>
struct Action<grammar::plus_> : Operator<Kind::add> {};
template <>
struct Action<grammar::minus_> : Operator<Kind::subtract> {};
template <>
struct Action<grammar::below> : Operator<Kind::less> {};
template <>
struct Action<grammar::at_most> : Operator<Kind::less_equal> {};
template <>
struct Action<grammar::above> : Operator<Kind::greater> {};
template <>
struct Action<grammar::at_least> : Operator<Kind::greater_equal> {};

template <>
struct Action<grammar::number> {
  static void apply(const auto& in, Left& left) {
    left.pieces.push_back({Kind::number, in.position().byte, in.string()});
  }
};
template <>
struct Action<grammar::unit> {
  static void apply(const auto& in, Left& left) { left.pieces.back().unit = in.string(); }
};
template <>
struct Action<grammar::name> {
  static void apply(const auto& in, Left& left) {
    left.pieces.push_back({Kind::name, in.position().byte, in.string()});
  }
};
template <>
struct Action<grammar::begin_call> {  // the name before it was that of a function
  static void apply0(Left& left) {
    left.open.push_back({left.pieces.back().offset, left.pieces.back().text, 0});
    left.pieces.pop_back();
  }
};
template <>
struct Action<grammar::argument> {
  static void apply0(Left& left) { ++left.open.back().arguments; }
};
template <>
struct Action<grammar::end_call> {
  static void apply(const auto& in, Left& left) {
    const Left::Call& call = left.open.back();
    left.pieces.push_back({Kind::call, call.offset, call.name, {}, call.arguments, in.position().byte + 1});
    left.open.pop_back();
  }
};
template <>
struct Action<grammar::group> {
  static void apply(const auto& in, Left& left) {
    const std::size_t begin = in.position().byte;
    left.pieces.push_back({Kind::group, begin, {}, {}, 0, begin + in.size()});
  }
};

/// Where brackets do not match, or are too many in each other for a parser that goes down into them.
bool brackets_are_well(std::string_view text, std::vector<Problem>& problems) {
  std::vector<std::size_t> open;
  std::size_t signs = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    signs = text[i] == '-' || text[i] == '^' ? signs + 1 : signs;
    if (text[i] == '(') open.push_back(i);
    if (text[i] == ')') {
      if (open.empty()) {
        problems.push_back({i, "this bracket ) was never opened"});
        return false;
      }
      open.pop_back();
    }
    if (open.size() > deepest_law || signs > 10 * deepest_law) {
      problems.push_back({i, fmt::format("nested deeper than {} brackets", deepest_law)});
      return false;
    }
  }
  if (!open.empty()) problems.push_back({open.back(), "this bracket ( is never closed"});
  return open.empty();
}

}  // namespace

std::vector<Piece> parse(std::string_view text, std::vector<Problem>& problems) {
  if (std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c) != 0; })) {
    problems.push_back({0, "the law is empty"});
    return {};
  }
  if (text.size() > longest_law) {
    problems.push_back({longest_law, fmt::format("longer than {} characters", longest_law)});
    return {};
  }
  if (!brackets_are_well(text, problems)) return {};
  pegtl::memory_input<> in(text.data(), text.data() + text.size(), "law");
  Left left;
  try {
    pegtl::parse<grammar::law, Action, Control>(in, left);
  } catch (const pegtl::parse_error& error) {
    problems.push_back({error.positions().front().byte, std::string(error.message())});
    return {};
  }
  return std::move(left.pieces);
}

}  // namespace mckibben::law
