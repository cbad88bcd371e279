/**
 * Text without links. Where the editor shows a notification or a prompt, it makes links of `[label](command:...)`, a click
 * on which runs the command; names of files, nodes and arguments are those of whoever wrote the workspace.
 */
export function plain(text: string): string {
  return text.replaceAll("](", "] (");
}

/** What is shown as a notification. */
export function notice(text: string): string {
  return `ROS Preflight: ${plain(text)}`;
}
