// What data leave open, of slopes made by hand: each row is a reading, each column a number.
#include <cmath>

#include <gtest/gtest.h>

#include <sim/diagnose/left_open.hpp>
#include <sim/diagnose/parameter.hpp>

namespace mckibben::diagnose {
namespace {

/// Of numbers of the nominal rig, each with this share of its value for its deviation. `inflation`: readings
/// that say so much less.
std::vector<LeftOpen> left(const std::vector<std::string>& paths, const Eigen::MatrixXd& columns,
                           double inflation = 1.0) {
  Rig rig;
  std::vector<FittedOne> numbers;
  for (const std::string& path : paths) {
    const Found found = find(rig, path);
    numbers.push_back({path, std::string(found.unit), *found.value, 0.5 * std::abs(*found.value)});
  }
  return left_open(columns.transpose() * columns / inflation, numbers);
}

const std::vector<std::string> three{"muscle.rest_radius", "friction.scale", "valve.conductance"};

TEST(LeftOpen, IsNothingWhereEachNumberMovesReadingsOfItsOwn) {
  EXPECT_TRUE(left(three, 5.0 * Eigen::Matrix3d::Identity()).empty());
}

TEST(LeftOpen, IsANumberThatNoReadingTellsEnoughOf) {
  Eigen::Matrix3d columns = 5.0 * Eigen::Matrix3d::Identity();
  columns(1, 1) = 0.4;
  const auto open = left(three, columns);
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].parameters, std::vector<std::string>{"friction.scale"});
  EXPECT_EQ(open[0].words, "friction.scale is not determined");
  columns(1, 1) = 0.6;
  EXPECT_TRUE(left(three, columns).empty());
  EXPECT_EQ(left(three, columns, 4.0).size(), 1u);  // readings that say less
}

TEST(LeftOpen, IsAProductOrARatioByHowTwoNumbersGoTogether) {
  Eigen::MatrixXd columns(4, 3);
  columns << 9, 9, 0, 3, 3, 0, 0, 0, 7, 0, 0, 1;
  const auto product = left(three, columns);
  ASSERT_EQ(product.size(), 1u);
  EXPECT_EQ(product[0].known, "product");
  EXPECT_EQ(product[0].words, "only the product of muscle.rest_radius and friction.scale is known");
  columns.col(1) *= -1.0;
  EXPECT_EQ(left(three, columns).at(0).known, "ratio");
  columns.col(1) *= 2.0;  // the radius against the square root
  const auto bent = left(three, columns);
  ASSERT_EQ(bent.size(), 1u);
  EXPECT_EQ(bent[0].known, "combination");
  EXPECT_EQ(bent[0].words,
            "muscle.rest_radius and friction.scale are known together only: one combination of them");
}

TEST(LeftOpen, IsASumOfNumbersInOneUnitOneOfWhichMayBeNothing) {
  const std::vector<FittedOne> numbers{{"valve.zero_pressure", "Pa", 0.0, 1e3},
                                       {"valve.span_pressure", "Pa", 5e5, 1e3}};
  Eigen::Matrix2d information = Eigen::Matrix2d::Constant(48.0);
  EXPECT_EQ(left_open(information, numbers).at(0).words,
            "only the sum of valve.zero_pressure and valve.span_pressure is known");
  information(0, 1) = information(1, 0) = -48.0;
  EXPECT_EQ(left_open(information, numbers).at(0).known, "difference");
}

TEST(LeftOpen, IsOneProductOfThreeNumbersAndNotThreeOfTwo) {
  const auto open = left(three, Eigen::MatrixXd::Constant(5, 3, 6.0));
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].words,
            "only the product of muscle.rest_radius, friction.scale and valve.conductance is known");
}

TEST(LeftOpen, CountsTheCombinationsOfMany) {
  const std::vector<std::string> five{"muscle.rest_radius", "friction.scale", "valve.conductance",
                                      "hose.conductance", "muscle.dead_volume"};
  // Every four of the five are known if the fifth is.
  Eigen::MatrixXd columns = 9.0 * Eigen::MatrixXd::Identity(5, 5);
  columns -= Eigen::MatrixXd::Constant(5, 5, 9.0 / 5.0);
  const auto open = left(five, columns);
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].parameters.size(), 5u);
  EXPECT_EQ(open[0].words.substr(0, 26), "of muscle.rest_radius, fri");
  EXPECT_NE(open[0].words.find("only 4 combinations are known"), std::string::npos) << open[0].words;
}

}  // namespace
}  // namespace mckibben::diagnose
