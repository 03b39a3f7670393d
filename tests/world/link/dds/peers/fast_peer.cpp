// A peer on Fast DDS in C++, as rmw_fastrtps speaks: `tf` and `tf_static` out and in.
#include <chrono>
#include <cstring>
#include <iostream>
#include <thread>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include "tfPubSubTypes.h"

using namespace eprosima::fastdds;
using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::SerializedPayload_t;
using Message = tf2_msgs::msg::dds_::TFMessage_;

template <class Qos> Qos quality(Qos qos, bool latched) {
  qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = latched ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
  qos.history().kind = KEEP_LAST_HISTORY_QOS;
  qos.history().depth = latched ? 1 : 400;  // tf2 keeps 100: no busy machine makes a test lose one
  return qos;
}

void send(DataWriter* writer, const char* parent, const char* child, int count) {
  geometry_msgs::msg::dds_::TransformStamped_ one;
  one.header().stamp().sec(1000 + count / 100);
  one.header().stamp().nanosec(count % 100 * 10000000u);
  one.header().frame_id(parent);
  one.child_frame_id(child);
  one.transform().translation().x(count * 0.5);
  one.transform().rotation().w(1.0);
  Message message;
  message.transforms().push_back(one);
  writer->write(&message);
}

void hear(DataReader* reader, const char* topic) {
  Message message;
  SampleInfo info;
  while (reader->take_next_sample(&message, &info) == ReturnCode_t::RETCODE_OK) {
    if (!info.valid_data) continue;
    for (auto& one : message.transforms())
      std::cout << topic << ' ' << one.header().frame_id() << ' ' << one.child_frame_id() << ' '
                << one.header().stamp().sec() << ' ' << one.header().stamp().nanosec() << ' '
                << one.transform().translation().x() << std::endl;
  }
}

// Bytes of any kind under the name of a type, in front of those that are well-formed.
class Garbage : public tf2_msgs::msg::dds_::TFMessage_PubSubType {
 public:
  Garbage() { m_typeSize = 12000000; }
  bool serialize(void* data, SerializedPayload_t* payload) override {
    auto seed = static_cast<unsigned*>(data);
    const unsigned sizes[] = {4, 5, 8, 40, 1000, 10000000};
    payload->encapsulation = CDR_LE;
    payload->length = sizes[*seed % 6];
    for (unsigned at = 0; at < payload->length; at++)
      payload->data[at] = at < 4 ? at == 1 : (*seed / 6) * 2654435761u * (at + 1) >> 13;
    return true;
  }
  std::function<uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return 10000008u; };
  }
};

int main(int, char** argv) {  // domain mode count
  DomainParticipantQos ours;
  ours.name("fast_peer");
  auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  udp->maxInitialPeersRange = 20;
  ours.transport().use_builtin_transports = false;
  ours.transport().user_transports.push_back(udp);
  eprosima::fastrtps::rtps::Locator_t near;
  eprosima::fastrtps::rtps::IPLocator::setIPv4(near, "127.0.0.1");
  ours.wire_protocol().builtin.initialPeersList.push_back(near);
  ours.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(near);
  auto us = DomainParticipantFactory::get_instance()->create_participant(std::stoi(argv[1]), ours);
  if (us == nullptr) return 1;
  bool is_hostile = std::strcmp(argv[2], "hostile") == 0;
  TypeSupport type(is_hostile ? new Garbage() : new tf2_msgs::msg::dds_::TFMessage_PubSubType());
  type.register_type(us, "tf2_msgs::msg::dds_::TFMessage_");
  auto tf = us->create_topic("rt/tf", type.get_type_name(), TOPIC_QOS_DEFAULT);
  auto fixed = us->create_topic("rt/tf_static", type.get_type_name(), TOPIC_QOS_DEFAULT);
  if (std::strcmp(argv[2], "sub") == 0) {
    auto in = us->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
    auto moving = in->create_datareader(tf, quality(DATAREADER_QOS_DEFAULT, false));
    auto still = in->create_datareader(fixed, quality(DATAREADER_QOS_DEFAULT, true));
    std::cout << "ready" << std::endl;
    for (;; std::this_thread::sleep_for(std::chrono::milliseconds(1)))
      hear(moving, "tf"), hear(still, "tf_static");
  }
  auto out = us->create_publisher(PUBLISHER_QOS_DEFAULT);
  auto moving = out->create_datawriter(tf, quality(DATAWRITER_QOS_DEFAULT, false));
  auto still = out->create_datawriter(fixed, quality(DATAWRITER_QOS_DEFAULT, true));
  if (!is_hostile) send(still, "base", "laser", 1);
  std::cout << "ready" << std::endl;
  PublicationMatchedStatus matched;
  while (matched.current_count < 1) {
    moving->get_publication_matched_status(matched);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  for (int i = 0; i < std::stoi(argv[3]); i++) {
    unsigned seed = i;
    is_hostile ? (void)moving->write(&seed) : send(moving, "odom", "base", i);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::cout << "sent" << std::endl;
  std::this_thread::sleep_for(std::chrono::minutes(10));
}
