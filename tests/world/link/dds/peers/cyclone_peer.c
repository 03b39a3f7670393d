/* A peer on Cyclone DDS in C, as rmw_cyclonedds speaks: `tf` and `tf_static` out and in. */
#include "dds/dds.h"
#include "tf.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef tf2_msgs_msg_dds__TFMessage_ Message;

static dds_qos_t *quality(bool latched, bool reliable) {
  dds_qos_t *qos = dds_create_qos();
  dds_qset_reliability(qos, reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_SECS(10));
  dds_qset_durability(qos, latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  /* tf2 keeps 100: more, so that no busy machine makes a test lose one. */
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, latched ? 1 : 400);
  if (latched) dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, 1, -1, -1, -1);
  return qos;
}

static void send(dds_entity_t writer, const char *parent, const char *child, int count, int n) {
  geometry_msgs_msg_dds__TransformStamped_ *one = calloc((size_t)n, sizeof *one);
  char names[1000][40];
  for (int i = 0; i < n; i++) {
    snprintf(names[i], sizeof names[i], i ? "%s%d" : "%s", child, i);
    one[i].header.stamp.sec = 1000 + count / 100;
    one[i].header.stamp.nanosec = (uint32_t)(count % 100) * 10000000u;
    one[i].header.frame_id = (char *)parent;
    one[i].child_frame_id = names[i];
    one[i].transform.translation.x = count * 0.5;
    one[i].transform.rotation.w = 1.0;
  }
  Message message = {{(uint32_t)n, (uint32_t)n, one, false}};
  if (dds_write(writer, &message) < 0) fprintf(stderr, "not written\n");
  free(one);
}

static void hear(dds_entity_t reader, const char *topic) {
  void *samples[100] = {0};
  dds_sample_info_t infos[100];
  int n = dds_take(reader, samples, infos, 100, 100);
  for (int i = 0; i < n; i++) {
    Message *message = samples[i];
    for (uint32_t j = 0; infos[i].valid_data && j < message->transforms._length; j++) {
      geometry_msgs_msg_dds__TransformStamped_ *one = &message->transforms._buffer[j];
      printf("%s %s %s %d %u %g\n", topic, one->header.frame_id, one->child_frame_id,
             one->header.stamp.sec, one->header.stamp.nanosec, one->transform.translation.x);
    }
  }
  if (n > 0) dds_return_loan(reader, samples, n);
  fflush(stdout);
}

int main(int argc, char **argv) { /* domain mode count period_us transforms */
  dds_entity_t us = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  bool writes = strncmp(argv[2], "pub", 3) == 0, reliable = strcmp(argv[2], "pub_best_effort") != 0;
  int total = argc > 3 ? atoi(argv[3]) : 0, period = argc > 4 ? atoi(argv[4]) : 10000;
  int n = argc > 5 ? atoi(argv[5]) : 1;
  dds_entity_t tf = dds_create_topic(us, &tf2_msgs_msg_dds__TFMessage__desc, "rt/tf", NULL, NULL);
  dds_entity_t fixed =
      dds_create_topic(us, &tf2_msgs_msg_dds__TFMessage__desc, "rt/tf_static", NULL, NULL);
  if (us < 0 || tf < 0 || fixed < 0) return 1;
  if (!writes) {
    dds_entity_t in = dds_create_reader(us, tf, quality(false, true), NULL);
    dds_entity_t in_static = dds_create_reader(us, fixed, quality(true, true), NULL);
    printf("ready\n");
    for (;; dds_sleepfor(DDS_MSECS(1))) hear(in, "tf"), hear(in_static, "tf_static");
  }
  dds_entity_t out = dds_create_writer(us, tf, quality(false, reliable), NULL);
  dds_entity_t out_static = dds_create_writer(us, fixed, quality(true, true), NULL);
  send(out_static, "base", "laser", 1, 1);
  printf("ready\n");
  fflush(stdout);
  dds_publication_matched_status_t matched = {0};
  while (matched.current_count < 1)
    dds_get_publication_matched_status(out, &matched), dds_sleepfor(DDS_MSECS(1));
  for (int i = 0; i < total; i++, dds_sleepfor(DDS_USECS(period))) send(out, "odom", "base", i, n);
  printf("sent\n");
  fflush(stdout);
  dds_sleepfor(DDS_SECS(600));
}
