#include "mpi/comm/message.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "mpi/comm/pending_messages.h"
#include "mpi/spaces/step/wire.h"

namespace pbmpi::mpi {
namespace {

TEST(Message, reads_back_arrays_of_any_type_and_length) {
  MessageWriter writer;
  writer.put(std::vector<char>{'a', 'b', 'c'});
  writer.put(std::vector<double>{});
  writer.put_value(std::int32_t{-7});
  writer.put(std::vector<double>{0.1, -0.0});
  MessageReader reader(writer.take());
  EXPECT_EQ(reader.get<char>().size(), 3u);
  EXPECT_TRUE(reader.get<double>().empty());
  EXPECT_EQ(reader.get_value<std::int32_t>(), -7);
  const auto doubles = reader.get<double>();
  ASSERT_EQ(doubles.size(), 2u);
  EXPECT_EQ(doubles[0], 0.1);
  EXPECT_TRUE(std::signbit(doubles[1]));
}

TEST(Message, refuses_to_read_more_than_was_put) {
  MessageWriter writer;
  writer.put(std::vector<int>{1, 2, 3});
  std::vector<std::byte> bytes = writer.take();
  bytes.resize(bytes.size() - 8);
  MessageReader cut(bytes);
  EXPECT_THROW(cut.get<int>(), std::logic_error);
  MessageReader empty({});
  EXPECT_THROW(empty.get<int>(), std::logic_error);
}

TEST(Wire, carries_every_bit_of_a_contact) {
  model::Contact contact;
  contact.geoms = {3, 8};
  contact.body_a = 2;
  contact.body_b = model::no_body;
  contact.position = {0.1, -0.0, std::numeric_limits<double>::denorm_min()};
  contact.normal = {1.0 / 3, 2.0 / 3, -2.0 / 3};
  contact.depth = 1e-300;
  contact.mu = 0.7;
  contact.restitution = 0.3;
  const model::Contact back = from_wire(to_wire(contact));
  EXPECT_EQ(back.geoms, contact.geoms);
  EXPECT_EQ(back.body_a, contact.body_a);
  EXPECT_EQ(back.body_b, contact.body_b);
  EXPECT_EQ(back.position, contact.position);
  EXPECT_TRUE(std::signbit(back.position.y()));
  EXPECT_EQ(back.normal, contact.normal);
  EXPECT_EQ(back.depth, contact.depth);
  EXPECT_EQ(back.mu, contact.mu);
  EXPECT_EQ(back.restitution, contact.restitution);
}

TEST(Wire, merges_contacts_into_canonical_order) {
  const auto touching = [](int first, int second, double depth) {
    model::Contact contact;
    contact.geoms = {first, second};
    contact.position = contact.normal = model::Vec3::Zero();
    contact.depth = depth;
    return contact;
  };
  std::vector<model::Contact> contacts = {touching(0, 4, 1), touching(0, 4, 2), touching(3, 5, 1)};
  const std::vector<WireContact> more = {to_wire(touching(0, 2, 1)), to_wire(touching(1, 2, 1)),
                                         to_wire(touching(1, 2, 2))};
  merge_contacts(more, contacts);
  std::vector<std::array<double, 3>> order;
  for (const model::Contact& c : contacts)
    order.push_back({1.0 * c.geoms.first, 1.0 * c.geoms.second, c.depth});
  const std::vector<std::array<double, 3>> expected = {{0, 2, 1}, {0, 4, 1}, {0, 4, 2},
                                                       {1, 2, 1}, {1, 2, 2}, {3, 5, 1}};
  EXPECT_EQ(order, expected);
}

TEST(Mail, brings_messages_of_any_length_in_order_and_counts_them) {
  const Communicator comm = Communicator::world();
  Mail mail(comm);
  const int next = (comm.rank() + 1) % comm.size();
  const int previous = (comm.rank() + comm.size() - 1) % comm.size();
  // More than fits into an eager buffer: all ranks send before any rank receives.
  const std::vector<std::size_t> lengths = {0, 1, 200000, 7};
  for (const std::size_t length : lengths)
    mail.post(std::vector<std::byte>(length, static_cast<std::byte>(comm.rank())), next, 5);
  for (const std::size_t length : lengths) {
    const std::vector<std::byte> message = mail.take(previous, 5);
    ASSERT_EQ(message.size(), length);
    for (const std::byte value : message) ASSERT_EQ(value, static_cast<std::byte>(previous));
  }
  mail.finish();
  const core::Traffic traffic = mail.take_traffic();
  EXPECT_EQ(traffic.messages, 4);
  EXPECT_EQ(traffic.bytes, 200008);
  EXPECT_EQ(mail.take_traffic().messages, 0);
}

}  // namespace
}  // namespace pbmpi::mpi
