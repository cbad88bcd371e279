"""A launch of Nav2's navigator with a behaviour tree, as fixtures of `support.check`."""


def navigator(tree: str, libraries: str = "") -> str:
    """A launch whose bt_navigator loads the tree; `libraries` are those that it lists, with commas between them."""
    listed = f'\n<param name="plugin_lib_names" value="{libraries}" value-sep=","/>' if libraries else ""
    packages = "".join(
        f'//- /{name}/package.xml\n<package format="3"><name>{name}</name><version>1.0.0</version>'
        "<export><build_type>ament_cmake</build_type></export></package>\n"
        for name in ("nav2_bt_navigator", "nav2_lifecycle_manager")
    )
    return f"""//- /robot.launch.xml
<launch>
<node pkg="nav2_bt_navigator" exec="bt_navigator" name="bt_navigator">
<param name="default_nav_to_pose_bt_xml" value="/trees/nav.xml"/>{listed}
</node>
<node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="manager">
<param name="autostart" value="true"/>
<param name="node_names" value="bt_navigator" value-sep=","/>
</node>
</launch>
{packages}//- /trees/nav.xml
{tree}"""
