import type { Uri } from "vscode";

/** The part of the Python extension's public interface that is used here. */
export interface PythonApi {
  readonly environments: {
    getActiveEnvironmentPath(resource?: Uri): { readonly path: string };
    resolveEnvironment(
      environment: { readonly path: string },
    ): Promise<{ readonly executable: { readonly uri: Uri | undefined } } | undefined>;
  };
}

/** The file of the interpreter that is selected for a folder, if the Python extension knows one. */
export async function selectedInterpreter(api: PythonApi, folder: Uri | undefined): Promise<string | undefined> {
  const environment = await api.environments.resolveEnvironment(api.environments.getActiveEnvironmentPath(folder));
  return environment?.executable.uri?.fsPath;
}
