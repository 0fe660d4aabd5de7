#include "solver/contacts/manifold_order.h"

#include <gtest/gtest.h>

#include <array>

namespace pbmpi::solver {
namespace {

constexpr int num_lanes = 4, static_slot = 50;

struct Given {
  int color, num_points;
};

/// Manifold i is that of body i with the environment.
class Deal {
 public:
  explicit Deal(const std::vector<Given>& manifolds) {
    int body = 0;
    for (const Given& given : manifolds) {
      order_.add({contacts_.data(),
                  nullptr,
                  static_cast<short>(given.num_points),
                  static_cast<short>(given.color),
                  {body++, 0},
                  {static_slot, 0}});
    }
    dealt_ = order_.deal(num_lanes, static_slot);
  }
  const ManifoldOrder& order() const { return order_; }
  const Manifold& at(int slot, int lane) const {
    return dealt_[static_cast<std::size_t>(slot * num_lanes + lane)];
  }

 private:
  std::array<model::Contact, ManifoldOrder::most_points> contacts_;
  ManifoldOrder order_;
  std::span<const Manifold> dealt_;
};

TEST(ManifoldOrder, a_slot_holds_one_colour) {
  const Deal deal({{2, 1}, {0, 1}, {2, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}});
  ASSERT_EQ(deal.order().num_slots(), 3);
  for (int slot = 0; slot < 3; ++slot) {
    for (int lane = 0; lane < num_lanes; ++lane) {
      if (deal.at(slot, lane).points != nullptr) {
        EXPECT_EQ(deal.at(slot, lane).color, slot < 2 ? 0 : 2);
      }
    }
  }
  const ManifoldOrder::SlotRange first = deal.order().slots_of(0), last = deal.order().slots_of(2);
  EXPECT_EQ(first.first, 0);
  EXPECT_EQ(first.end, 2);
  EXPECT_EQ(last.first, 2);
  EXPECT_EQ(last.end, 3);
}

TEST(ManifoldOrder, a_colour_that_no_manifold_has_has_no_slots) {
  const Deal deal({{2, 1}});
  for (const int color : {0, 1, 3, 100}) {
    EXPECT_EQ(deal.order().slots_of(color).first, deal.order().slots_of(color).end) << color;
  }
}

TEST(ManifoldOrder, manifolds_of_many_points_share_their_slots) {
  const Deal deal({{0, 1}, {0, 4}, {0, 2}, {0, 4}, {0, 1}, {0, 4}, {0, 3}});
  ASSERT_EQ(deal.order().num_slots(), 2);
  EXPECT_EQ(deal.order().num_points(0), 4);
  EXPECT_EQ(deal.order().num_points(1), 2);
}

TEST(ManifoldOrder, lanes_without_a_manifold_idle_on_the_static_slot) {
  const Deal deal({{0, 1}, {1, 1}});
  ASSERT_EQ(deal.order().num_slots(), 2);
  for (int slot = 0; slot < 2; ++slot) {
    EXPECT_EQ(deal.at(slot, 0).a.slot, slot);
    for (int lane = 1; lane < num_lanes; ++lane) {
      EXPECT_EQ(deal.at(slot, lane).points, nullptr);
      EXPECT_EQ(deal.at(slot, lane).num_points, 0);
      EXPECT_EQ(deal.at(slot, lane).a.slot, static_slot);
      EXPECT_EQ(deal.at(slot, lane).b.slot, static_slot);
    }
  }
}

TEST(ManifoldOrder, nothing_is_left_of_the_last_deal) {
  ManifoldOrder order;
  std::array<model::Contact, 2> contacts;
  order.add({contacts.data(), nullptr, 2, 5, {0, 0}, {static_slot, 0}});
  order.deal(num_lanes, static_slot);
  order.clear();
  EXPECT_TRUE(order.deal(num_lanes, static_slot).empty());
  EXPECT_EQ(order.num_slots(), 0);
  EXPECT_EQ(order.slots_of(5).first, order.slots_of(5).end);
}

}  // namespace
}  // namespace pbmpi::solver
