"""SRV002: client and server of a service have different types."""

from pathlib import Path

import pytest
from support.check import check, findings_of


def test_types_that_differ() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="dock"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[SRV002] type mismatch on '/reset': /base serves std_srvs/Empty,
        </launch>
        //- interfaces
        {"/base": {"services": {"reset": "std_srvs/Empty"}}, "/dock": {"clients": {"reset": "std_srvs/Trigger"}}}
    """)


def test_a_client_whose_type_is_not_known_is_judged_by_its_sum() -> None:
    text = """
        <launch><node pkg="p" type="t" name="base"/><node pkg="p" type="t" name="dock"/></launch>
        //- interfaces
        {"/base": {"services": {"reset": "std_srvs/Empty"}, "md5": {"reset": "11"}},
         "/dock": {"clients": {"reset": null}, "md5": {"reset": "SUM"}}}
    """
    (finding,) = findings_of(text.replace("SUM", "22"))
    assert finding.rule == "SRV002"
    assert "/dock calls an unknown type (MD5 sums 11 and 22)" in finding.message
    assert findings_of(text.replace("SUM", "11")) == []
    assert findings_of(text.replace("SUM", "*")) == []


def test_one_service_type_of_two_definitions() -> None:
    (finding,) = findings_of("""
        <launch><node pkg="p" type="t" name="base"/><node pkg="p" type="t" name="dock"/></launch>
        //- interfaces
        {"/base": {"services": {"reset": "x/Reset"}, "md5": {"reset": "11"}},
         "/dock": {"clients": {"reset": "x/Reset"}, "md5": {"reset": "22"}}}
    """)
    assert "different definitions" in finding.message


@pytest.mark.silent
def test_types_of_one_definition_can_be_called() -> None:
    assert (
        findings_of("""
        <launch><node pkg="p" type="t" name="base"/><node pkg="p" type="t" name="dock"/></launch>
        //- interfaces
        {"/base": {"services": {"reset": "std_srvs/Empty"}, "md5": {"reset": "11"}},
         "/dock": {"clients": {"reset": "x/Nothing"}, "md5": {"reset": "11"}}}
    """)
        == []
    )


@pytest.mark.parametrize(("file", "severity"), [("GetList", "info"), ("Get", "error")])
def test_a_type_that_its_package_has_no_file_for(tmp_path: Path, file: str, severity: str) -> None:
    (tmp_path / "q" / "srv").mkdir(parents=True)
    (tmp_path / "q" / "srv" / f"{file}.srv").touch()
    text = f"""
        //- {tmp_path}/main.launch
        <launch><node pkg="p" type="t" name="base"/><node pkg="p" type="t" name="dock"/></launch>
        //- {tmp_path}/q/package.xml
        <package/>
        //- interfaces
        {{"/base": {{"services": {{"get": "core/Get"}}}}, "/dock": {{"clients": {{"get": "q/Get"}}}}}}
    """
    assert [f.severity for f in findings_of(text)] == [severity]
