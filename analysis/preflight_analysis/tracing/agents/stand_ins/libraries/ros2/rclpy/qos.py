"""Quality of service (https://docs.ros.org/en/jazzy/Concepts/Intermediate/About-Quality-of-Service-Settings.html)."""

from __future__ import annotations

import enum
from typing import Any

from .duration import Duration, Infinite


class QoSPolicyKind(enum.IntEnum):
    """Names of policies."""

    INVALID = 1
    DURABILITY = 2
    DEADLINE = 4
    LIVELINESS = 8
    RELIABILITY = 16
    HISTORY = 32
    LIFESPAN = 64
    DEPTH = 128
    LIVELINESS_LEASE_DURATION = 256
    AVOID_ROS_NAMESPACE_CONVENTIONS = 512


class InvalidQoSProfileException(Exception):
    """A profile is malformed."""

    def __init__(self, message: str) -> None:
        super().__init__(f"Invalid QoSProfile: {message}")


class QoSPolicyEnum(enum.IntEnum):
    """What policies have in common."""

    @classmethod
    def short_keys(cls) -> list[str]:
        return [each.name.lower() for each in cls]

    @classmethod
    def get_from_short_key(cls, name: str) -> int:
        return cls[name.upper()].value

    @property
    def short_key(self) -> str:
        return self.name.lower()


class HistoryPolicy(QoSPolicyEnum):
    """How many messages are kept."""

    SYSTEM_DEFAULT = RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT = 0
    KEEP_LAST = RMW_QOS_POLICY_HISTORY_KEEP_LAST = 1
    KEEP_ALL = RMW_QOS_POLICY_HISTORY_KEEP_ALL = 2
    UNKNOWN = RMW_QOS_POLICY_HISTORY_UNKNOWN = 3


class ReliabilityPolicy(QoSPolicyEnum):
    """Whether lost messages are sent again."""

    SYSTEM_DEFAULT = RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT = 0
    RELIABLE = RMW_QOS_POLICY_RELIABILITY_RELIABLE = 1
    BEST_EFFORT = RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT = 2
    UNKNOWN = RMW_QOS_POLICY_RELIABILITY_UNKNOWN = 3
    BEST_AVAILABLE = 4


class DurabilityPolicy(QoSPolicyEnum):
    """Whether later subscribers get earlier messages."""

    SYSTEM_DEFAULT = RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL = 1
    VOLATILE = RMW_QOS_POLICY_DURABILITY_VOLATILE = 2
    UNKNOWN = RMW_QOS_POLICY_DURABILITY_UNKNOWN = 3
    BEST_AVAILABLE = 4


class LivelinessPolicy(QoSPolicyEnum):
    """Who says that a publisher is alive."""

    SYSTEM_DEFAULT = RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT = 0
    AUTOMATIC = RMW_QOS_POLICY_LIVELINESS_AUTOMATIC = 1
    MANUAL_BY_TOPIC = RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC = 3
    UNKNOWN = RMW_QOS_POLICY_LIVELINESS_UNKNOWN = 4
    BEST_AVAILABLE = 5


QoSHistoryPolicy, QoSReliabilityPolicy = HistoryPolicy, ReliabilityPolicy
QoSDurabilityPolicy, QoSLivelinessPolicy = DurabilityPolicy, LivelinessPolicy
_ENUMS: dict[str, Any] = {
    "history": HistoryPolicy,
    "reliability": ReliabilityPolicy,
    "durability": DurabilityPolicy,
    "liveliness": LivelinessPolicy,
}
_DEFAULTS: dict[str, Any] = {
    "depth": 10,
    "reliability": ReliabilityPolicy.RELIABLE,
    "durability": DurabilityPolicy.VOLATILE,
    "lifespan": Duration(),
    "deadline": Duration(),
    "liveliness": LivelinessPolicy.SYSTEM_DEFAULT,
    "liveliness_lease_duration": Duration(),
    "avoid_ros_namespace_conventions": False,
}
_ORDER = ("history", *_DEFAULTS)


class QoSProfile:
    """All policies of one end."""

    def __init__(self, history: Any = None, depth: Any = None, *rest: Any, **kwargs: Any) -> None:
        given = dict(zip(_ORDER[2:], rest), **kwargs)
        unknown = given.keys() - set(_ORDER)
        if unknown:
            raise TypeError(f"QoSProfile() got an unexpected keyword argument {min(unknown)!r}")
        if history is None:
            if depth is None:
                raise InvalidQoSProfileException("History and/or depth settings are required.")
            history = HistoryPolicy.KEEP_LAST
        if history == HistoryPolicy.KEEP_LAST and depth is None:
            raise InvalidQoSProfileException("History set to KEEP_LAST without a depth setting.")
        self.history = history
        for name, default in _DEFAULTS.items():
            value = depth if name == "depth" else given.get(name)
            setattr(self, name, default if value is None else value)

    def __setattr__(self, name: str, value: Any) -> None:
        kind = _ENUMS.get(name)
        object.__setattr__(self, name, kind(value) if kind is not None and isinstance(value, int) else value)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, QoSProfile) and vars(other) == vars(self)

    __hash__ = None  # type: ignore[assignment]

    def __str__(self) -> str:
        return f"QoSProfile({', '.join(f'{name}={getattr(self, name)}' for name in _ORDER)})"

    def get_c_qos_profile(self) -> Any:
        return self


class DeprecatedQoSProfile(QoSProfile):
    """One by an old name."""


def qos_check_compatible(publisher_qos: Any, subscription_qos: Any) -> tuple[int, str]:
    """Whether two ends are connected; it is taken to be so."""
    return 0, ""


DeadlineBestAvailable = LivelinessLeaseDurationeBestAvailable = Infinite
_LAST, _BEST = HistoryPolicy.KEEP_LAST, ReliabilityPolicy.BEST_EFFORT
qos_profile_unknown = QoSProfile(3, 0, 3, 3, liveliness=4)
qos_profile_default = QoSProfile(_LAST, 10)
qos_profile_system_default = QoSProfile(0, 0, 0, 0)
qos_profile_sensor_data = QoSProfile(_LAST, 5, _BEST)
qos_profile_services_default = QoSProfile(_LAST, 10)
qos_profile_parameters = QoSProfile(_LAST, 1000)
qos_profile_parameter_events = QoSProfile(_LAST, 1000)
qos_profile_best_available = QoSProfile(_LAST, 10, 4, 4, liveliness=5)
qos_profile_action_status_default = QoSProfile(_LAST, 1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
qos_profile_rosout_default = QoSProfile(_LAST, 1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class QoSPresetProfiles(enum.Enum):
    """Profiles by name."""

    UNKNOWN = qos_profile_unknown
    DEFAULT = qos_profile_default
    SYSTEM_DEFAULT = qos_profile_system_default
    SENSOR_DATA = qos_profile_sensor_data
    SERVICES_DEFAULT = qos_profile_services_default
    PARAMETERS = qos_profile_parameters
    PARAMETER_EVENTS = qos_profile_parameter_events
    ACTION_STATUS_DEFAULT = qos_profile_action_status_default
    BEST_AVAILABLE = qos_profile_best_available

    @classmethod
    def short_keys(cls) -> list[str]:
        return [name.lower() for name in cls.__members__]

    @classmethod
    def get_from_short_key(cls, name: str) -> Any:
        return cls[name.upper()].value


class QoSCompatibility(enum.IntEnum):
    """Whether two ends fit."""

    OK = 0
    WARNING = 1
    ERROR = 2


def qos_policy_name_from_kind(policy_kind: Any) -> str:
    return QoSPolicyKind(policy_kind).name
