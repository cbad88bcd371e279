;;; Opens a launch file in Emacs as docs/other_editors.md sets it up, and writes what eglot shows of it, as JSON.
;;; Usage: emacs --batch -l INIT -l drive.el -f drive -- LAUNCH-FILE RESULT SCENARIO

(require 'json)
(require 'flymake)

(defun drive-wait (what condition)
  "Wait until CONDITION returns something, and return it."
  (let ((end (+ (float-time) 60)) found)
    (while (not (setq found (funcall condition)))
      (when (> (float-time) end)
        (error "waited in vain for %s; there are: %s" what (drive-findings)))
      (accept-process-output nil 0.05))
    found))

(defun drive-findings ()
  "What Flymake has of this buffer: code and message, with the place."
  (mapcar (lambda (found)
            `((text . ,(flymake-diagnostic-text found))
              (line . ,(line-number-at-pos (flymake-diagnostic-beg found)))
              (underlined . ,(buffer-substring-no-properties
                              (flymake-diagnostic-beg found) (flymake-diagnostic-end found)))))
          (flymake-diagnostics)))

(defun drive-with (text)
  "The finding whose text has TEXT."
  (seq-find (lambda (found) (string-match-p text (flymake-diagnostic-text found))) (flymake-diagnostics)))

(defun drive ()
  (pcase-let ((`(,file ,result ,scenario) (cdr (member "--" command-line-args))))
    (find-file file)
    (run-hooks 'post-command-hook)      ; eglot-ensure waits for it
    (drive-wait "the server" #'eglot-current-server)
    (let ((wanted (if (equal scenario "trusted") "did you mean" "not trusted")) said before after)
      (setq before (progn (drive-wait wanted (lambda () (drive-with wanted))) (drive-findings)))
      (when (equal scenario "trusted")
        (let ((finding (drive-with "did you mean"))
              (last-nonmenu-event ?x))  ; asked by keyboard, not by a menu
          (cl-letf (((symbol-function 'completing-read)
                     (lambda (_prompt options &rest _)
                       (setq said (mapcar (lambda (each) (if (consp each) (car each) each)) options))
                       (seq-find (lambda (each) (string-prefix-p "Replace" each)) said))))
            (eglot-code-actions (flymake-diagnostic-beg finding) (flymake-diagnostic-end finding) nil t)))
        (eglot--signal-textDocument/didChange) ; what an idle timer does, which --batch has not
        (drive-wait "what is left" (lambda ()
                                     (and (drive-with "to itself has no effect") (not (cdr (flymake-diagnostics))))))
        (save-buffer))
      (setq after (drive-findings))
      (with-temp-file result
        (insert (json-encode `((before . ,(vconcat before)) (offered . ,(vconcat said)) (after . ,(vconcat after))))))
      (eglot-shutdown (eglot-current-server)))))
