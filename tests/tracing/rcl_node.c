/* A node on rcl alone, as a client library in C or C++ would make one. The first argument is what it does. */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <fib/action/fib.h>
#include <lifecycle_msgs/msg/transition_event.h>
#include <lifecycle_msgs/srv/change_state.h>
#include <lifecycle_msgs/srv/get_available_states.h>
#include <lifecycle_msgs/srv/get_available_transitions.h>
#include <lifecycle_msgs/srv/get_state.h>
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rcl_action/rcl_action.h>
#include <rcl_interfaces/msg/parameter_event.h>
#include <rcl_lifecycle/rcl_lifecycle.h>
#include <rmw/qos_profiles.h>
#include <std_msgs/msg/string.h>
#include <std_srvs/srv/empty.h>
#include <std_srvs/srv/trigger.h>

#define STRING ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String)
#define SERVICE(package, name) ROSIDL_GET_SRV_TYPE_SUPPORT(package, srv, name)
#define NEW(type, init) *(type*)memcpy(malloc(sizeof(type)), &(type[1]){init}, sizeof(type))

/* The libraries of PyPI's wheels are linked with those of the messages for Python, which look for these. */
void *PyExc_RuntimeError, *_Py_TrueStruct;

static rcl_context_t context;
static rcl_node_t node;
static rcl_service_t* own_service;

static void check(rcl_ret_t result) {
  if (result == RCL_RET_OK) return;
  fprintf(stderr, "error: %s\n", rcl_get_error_string().str);
  exit(3);
}

static rcl_publisher_t* publish(const char* topic, rmw_qos_profile_t qos) {
  rcl_publisher_t* made = &NEW(rcl_publisher_t, rcl_get_zero_initialized_publisher());
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  options.qos = qos;
  check(rcl_publisher_init(made, &node, STRING, topic, &options));
  return made;
}

static rcl_subscription_t* subscribe(const char* topic, rmw_qos_profile_t qos) {
  rcl_subscription_t* made = &NEW(rcl_subscription_t, rcl_get_zero_initialized_subscription());
  rcl_subscription_options_t options = rcl_subscription_get_default_options();
  options.qos = qos;
  check(rcl_subscription_init(made, &node, STRING, topic, &options));
  return made;
}

static rcl_client_t* client(const rosidl_service_type_support_t* type, const char* name) {
  rcl_client_t* made = &NEW(rcl_client_t, rcl_get_zero_initialized_client());
  rcl_client_options_t options = rcl_client_get_default_options();
  check(rcl_client_init(made, &node, type, name, &options));
  return made;
}

static void serve(const rosidl_service_type_support_t* type, const char* name) {
  rcl_service_t* made = &NEW(rcl_service_t, rcl_get_zero_initialized_service());
  rcl_service_options_t options = rcl_service_get_default_options();
  check(rcl_service_init(made, &node, type, name, &options));
  own_service = made;
}

static void start(int argc, char** argv, const char* name, const char* space) {
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();
  check(rcl_init_options_init(&options, allocator));
  context = rcl_get_zero_initialized_context();
  check(rcl_init(argc, (const char* const*)argv, &options, &context));
  node = rcl_get_zero_initialized_node();
  rcl_node_options_t given = rcl_node_get_default_options();
  check(rcl_node_init(&node, name, space, &context, &given));
}

/* One turn of an event loop, with the service or the client that may have work. */
static void turn(const rcl_service_t* service, const rcl_client_t* asking, int64_t milliseconds) {
  rcl_wait_set_t set = rcl_get_zero_initialized_wait_set();
  rcl_guard_condition_t never = rcl_get_zero_initialized_guard_condition();
  check(rcl_guard_condition_init(&never, &context, rcl_guard_condition_get_default_options()));
  check(rcl_wait_set_init(&set, 0, 1, 0, asking != NULL, service != NULL, 0, &context, rcl_get_default_allocator()));
  check(rcl_wait_set_add_guard_condition(&set, &never, NULL));
  if (service != NULL) check(rcl_wait_set_add_service(&set, service, NULL));
  if (asking != NULL) check(rcl_wait_set_add_client(&set, asking, NULL));
  rcl_ret_t result = rcl_wait(&set, milliseconds < 0 ? -1 : RCL_MS_TO_NS(milliseconds));
  if (result != RCL_RET_TIMEOUT) check(result);
  check(rcl_wait_set_fini(&set));
  check(rcl_guard_condition_fini(&never));
}

static void* spin(void* unused) {
  (void)unused;
  for (;;) turn(own_service, NULL, -1);
}

static void* watch_graph(void* unused) {
  (void)unused;
  for (;;) turn(NULL, NULL, -1);
}

static void ends(void) {
  rmw_qos_profile_t latched = rmw_qos_profile_default;
  latched.depth = 1;
  latched.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  latched.deadline = (rmw_time_t){2, 500000000};
  publish("chatter", rmw_qos_profile_default);
  publish("~/state", latched);
  subscribe("/scan", rmw_qos_profile_sensor_data);
  serve(SERVICE(std_srvs, Empty), "reset");
  client(SERVICE(std_srvs, Empty), "/map/load");
}

/* Asks for a service until it is there, and goes on if it agrees. */
static void wait_for(const char* service) {
  rcl_client_t* asking = client(SERVICE(std_srvs, Trigger), service);
  for (bool there = false; !there; usleep(50000)) check(rcl_service_server_is_available(&node, asking, &there));
  std_srvs__srv__Trigger_Request request;
  std_srvs__srv__Trigger_Response response;
  std_srvs__srv__Trigger_Request__init(&request);
  std_srvs__srv__Trigger_Response__init(&response);
  int64_t sequence;
  rmw_request_id_t header;
  check(rcl_send_request(asking, &request, &sequence));
  while (rcl_take_response(asking, &header, &response) != RCL_RET_OK) {
    rcl_reset_error();
    turn(NULL, asking, -1);
  }
  publish(response.success ? "after" : "refused", rmw_qos_profile_default);
}

static void serve_action(const char* name) {
  rcl_action_server_t* made = &NEW(rcl_action_server_t, rcl_action_get_zero_initialized_server());
  rcl_action_server_options_t options = rcl_action_server_get_default_options();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_clock_t* clock = malloc(sizeof(rcl_clock_t));
  check(rcl_clock_init(RCL_STEADY_TIME, clock, &allocator));
  check(rcl_action_server_init(made, &node, clock, ROSIDL_GET_ACTION_TYPE_SUPPORT(fib, Fib), name, &options));
}

static void wait_for_action(const char* name) {
  rcl_action_client_t* made = &NEW(rcl_action_client_t, rcl_action_get_zero_initialized_client());
  rcl_action_client_options_t options = rcl_action_client_get_default_options();
  check(rcl_action_client_init(made, &node, ROSIDL_GET_ACTION_TYPE_SUPPORT(fib, Fib), name, &options));
  for (bool there = false; !there; usleep(50000)) check(rcl_action_server_is_available(&node, made, &there));
}

static void managed(int fail, int by_itself) {
  rcl_lifecycle_state_machine_t machine = rcl_lifecycle_get_zero_initialized_state_machine();
  rcl_lifecycle_state_machine_options_t options = rcl_lifecycle_get_default_state_machine_options();
  check(rcl_lifecycle_state_machine_init(
      &machine, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(lifecycle_msgs, msg, TransitionEvent),
      SERVICE(lifecycle_msgs, ChangeState), SERVICE(lifecycle_msgs, GetState),
      SERVICE(lifecycle_msgs, GetAvailableStates), SERVICE(lifecycle_msgs, GetAvailableTransitions),
      SERVICE(lifecycle_msgs, GetAvailableTransitions), &options));
  for (uint8_t id = 0; id < by_itself; ++id) {
    check(rcl_lifecycle_trigger_transition_by_id(&machine,
                                                 id == 0 ? lifecycle_msgs__msg__Transition__TRANSITION_CONFIGURE
                                                         : lifecycle_msgs__msg__Transition__TRANSITION_ACTIVATE,
                                                 true));
    check(rcl_lifecycle_trigger_transition_by_label(&machine, rcl_lifecycle_transition_success_label, true));
  }
  const rcl_service_t* change = &machine.com_interface.srv_change_state;
  for (;;) {
    turn(change, NULL, -1);
    lifecycle_msgs__srv__ChangeState_Request request;
    lifecycle_msgs__srv__ChangeState_Response response;
    lifecycle_msgs__srv__ChangeState_Request__init(&request);
    lifecycle_msgs__srv__ChangeState_Response__init(&response);
    rmw_request_id_t header;
    if (rcl_take_request(change, &header, &request) != RCL_RET_OK) continue;
    check(rcl_lifecycle_trigger_transition_by_id(&machine, request.transition.id, true));
    bool configures = request.transition.id == lifecycle_msgs__msg__Transition__TRANSITION_CONFIGURE;
    if (configures) publish("made", rmw_qos_profile_default);
    if (!configures) subscribe("active", rmw_qos_profile_default);
    response.success = !fail;
    const char* label = fail ? rcl_lifecycle_transition_failure_label : rcl_lifecycle_transition_success_label;
    check(rcl_lifecycle_trigger_transition_by_label(&machine, label, true));
    check(rcl_send_response(change, &header, &response));
  }
}

static rcl_interfaces__msg__Parameter* add(rcl_interfaces__msg__ParameterEvent* event, const char* name, int type) {
  rcl_interfaces__msg__Parameter* made = &event->new_parameters.data[event->new_parameters.size++];
  rosidl_runtime_c__String__assign(&made->name, name);
  made->value.type = type;
  return made;
}

/* Tells of parameters what a client library tells that declares them. */
static void declare(void) {
  rcl_publisher_t publisher = rcl_get_zero_initialized_publisher();
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  const rosidl_message_type_support_t* type = ROSIDL_GET_MSG_TYPE_SUPPORT(rcl_interfaces, msg, ParameterEvent);
  check(rcl_publisher_init(&publisher, &node, type, "/parameter_events", &options));
  rcl_interfaces__msg__ParameterEvent event;
  rcl_interfaces__msg__ParameterEvent__init(&event);
  rosidl_runtime_c__String__assign(&event.node, rcl_node_get_fully_qualified_name(&node));
  rcl_interfaces__msg__Parameter__Sequence__init(&event.new_parameters, 10);
  event.new_parameters.size = 0;
  add(&event, "use_sim_time", 1);
  add(&event, "on", 1)->value.bool_value = true;
  add(&event, "count", 2)->value.integer_value = -7;
  add(&event, "rate", 3)->value.double_value = 10.0;
  rosidl_runtime_c__String__assign(&add(&event, "frame.id", 4)->value.string_value, "a\"b");
  rosidl_runtime_c__double__Sequence* gains = &add(&event, "gains", 8)->value.double_array_value;
  rosidl_runtime_c__double__Sequence__init(gains, 2);
  gains->data[0] = 0.25;
  gains->data[1] = 3;
  rosidl_runtime_c__String__Sequence* frames = &add(&event, "frames", 9)->value.string_array_value;
  rosidl_runtime_c__String__Sequence__init(frames, 2);
  rosidl_runtime_c__String__assign(&frames->data[0], "map");
  rosidl_runtime_c__String__assign(&frames->data[1], "base");
  add(&event, "typed", 0);
  add(&event, "odd", 3)->value.double_value = 0.0 / 0.0;
  check(rcl_publish(&publisher, &event, NULL));
}

int main(int argc, char** argv) {
  const char* mode = argc > 1 ? argv[1] : "";
  if (strcmp(mode, "early") == 0) abort();
  start(argc, argv, "own", strcmp(mode, "elsewhere") == 0 ? "/there" : "");
  if (strcmp(mode, "wait") == 0) {
    wait_for("start");
  } else if (strcmp(mode, "watch") == 0) {
    pthread_t watcher;
    pthread_create(&watcher, NULL, watch_graph, NULL);
    wait_for("start");
  } else if (strcmp(mode, "managed") == 0) {
    managed(argc > 2 && strcmp(argv[2], "fail") == 0, argc > 3 ? atoi(argv[3]) : 0);
  } else if (strcmp(mode, "action") == 0) {
    serve_action("count");
    wait_for_action("~/other");
    publish("after", rmw_qos_profile_default);
  } else if (strcmp(mode, "declare") == 0) {
    declare();
  } else if (strcmp(mode, "talk") == 0) {
    publish(argv[2], rmw_qos_profile_default);
  } else if (strcmp(mode, "listen") == 0) {
    subscribe(argv[2], rmw_qos_profile_default);
  } else {
    ends();
  }
  if (strcmp(mode, "crash") == 0) abort();
  if (strcmp(mode, "exit") == 0) {
    /* Without it Fast DDS crashes now and then on the way out. */
    check(rcl_node_fini(&node));
    check(rcl_shutdown(&context));
    return atoi(argv[2]);
  }
  if (strcmp(mode, "poll") == 0) {
    for (;;) turn(NULL, NULL, 20);
  }
  if (strcmp(mode, "late") == 0) {
    turn(NULL, NULL, 20);
    publish("late", rmw_qos_profile_default);
  }
  pthread_t thread;
  if (strcmp(mode, "thread") == 0) {
    pthread_create(&thread, NULL, spin, NULL);
    pthread_join(thread, NULL);
  }
  if (strcmp(mode, "sleep") == 0) {
    for (;;) usleep(50000);
  }
  spin(NULL);
}
