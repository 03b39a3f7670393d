/* A service's two sides on Cyclone DDS in C, as rmw_cyclonedds speaks. */
#include "dds/dds.h"
#include "service.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef std_srvs_srv_dds__SetBool_Request_ Request;
typedef std_srvs_srv_dds__SetBool_Response_ Response;

int main(int argc, char **argv) { /* domain mode */
  (void)argc;
  dds_entity_t us = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  bool serves = strcmp(argv[2], "serve") == 0;
  dds_qos_t *qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  dds_entity_t requests = dds_create_topic(us, &std_srvs_srv_dds__SetBool_Request__desc,
                                           "rq/switchRequest", NULL, NULL);
  dds_entity_t replies = dds_create_topic(us, &std_srvs_srv_dds__SetBool_Response__desc,
                                          "rr/switchReply", NULL, NULL);
  dds_entity_t in = dds_create_reader(us, serves ? requests : replies, qos, NULL);
  dds_entity_t out = dds_create_writer(us, serves ? replies : requests, qos, NULL);
  void *samples[1] = {NULL};
  dds_sample_info_t info;
  dds_publication_matched_status_t readers = {0};
  dds_subscription_matched_status_t writers = {0};
  while (!serves && (readers.current_count < 1 || writers.current_count < 1)) {
    dds_get_publication_matched_status(out, &readers);
    dds_get_subscription_matched_status(in, &writers);
    dds_sleepfor(DDS_MSECS(1));
  }
  Request ours = {77, 5, true};
  if (!serves) dds_write(out, &ours);
  printf("ready\n");
  for (fflush(stdout);; dds_sleepfor(DDS_MSECS(1))) {
    if (dds_take(in, samples, &info, 1, 1) < 1) continue;
    if (info.valid_data && serves) {
      Request *asked = samples[0];
      Response reply = {asked->client_guid, asked->sequence_number, asked->data, "switched"};
      dds_write(out, &reply);
    } else if (info.valid_data) {
      Response *got = samples[0];
      printf("%d %d %d %s\n", (int)got->client_guid, (int)got->sequence_number, got->success,
             got->message);
      fflush(stdout);
    }
    dds_return_loan(in, samples, 1);
  }
}
